// SPDX-License-Identifier: Apache-2.0
#include "runner/workers.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <map>
#include <new>
#include <utility>

#include "cli/stop.hpp"
#include "runner/child.hpp"
#include "runner/wire.hpp"

namespace etendue::validation {

namespace {

/// Who runs which test, in memory that all processes share: 0 nobody yet, else the worker's number plus one.
class Board {
 public:
  static Result<Board> make(std::size_t tests) {
    void* memory = ::mmap(nullptr, tests + 1, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return Error{ErrorCode::input_output, "no memory to share with other processes"};
    return Board(new (memory) std::atomic<std::uint8_t>[tests + 1], tests);
  }
  bool take(std::size_t test, std::uint8_t worker) const {
    std::uint8_t nobody = 0;
    return taken_[test].compare_exchange_strong(nobody, static_cast<std::uint8_t>(worker + 1));
  }
  bool has(std::size_t test, std::uint8_t worker) const { return taken_[test] == worker + 1; }
  std::size_t size() const { return size_; }

 private:
  Board(std::atomic<std::uint8_t>* taken, std::size_t size) : taken_(taken), size_(size) {}
  std::atomic<std::uint8_t>* taken_;  // as long as the process lives
  std::size_t size_;
};

/// Every test of the program, selected or not.
std::vector<const ::testing::TestInfo*> all_tests() {
  std::vector<const ::testing::TestInfo*> tests;
  const auto& unit = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < unit.total_test_suite_count(); ++s) {
    const auto& suite = *unit.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) tests.push_back(suite.GetTestInfo(t));
  }
  return tests;
}

/// Skips what others run, keeps what the rest left behind.
class Taker : public ::testing::EmptyTestEventListener {
 public:
  Taker(const Board& board, std::uint8_t worker, WorkDone& work)
      : board_(board), worker_(worker), work_(work), collector_(found_) {
    for (const auto* info : all_tests()) indices_.emplace(info, indices_.size());
  }
  void OnTestStart(const ::testing::TestInfo& info) override {
    mine_ = board_.take(indices_.at(&info), worker_);
    if (!mine_) GTEST_SKIP();
    collector_.OnTestStart(info);
  }
  void OnTestEnd(const ::testing::TestInfo& info) override {
    if (!mine_) return;
    collector_.OnTestEnd(info);
    const auto& exhibits = collected_exhibits();
    work_.tests.push_back({indices_.at(&info),
                           std::move(found_.back()),
                           {exhibits.begin() + static_cast<std::ptrdiff_t>(shown_), exhibits.end()}});
    shown_ = exhibits.size();
  }

 private:
  Board board_;
  std::uint8_t worker_;
  WorkDone& work_;
  std::vector<TestRun> found_;
  Collector collector_;
  std::map<const ::testing::TestInfo*, std::size_t> indices_;
  std::size_t shown_ = 0;
  bool mine_ = false;
};

std::string work_text(const Board& board, std::uint8_t worker, Depth depth) {
  WorkDone work;
  auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new Taker(board, worker, work));  // GoogleTest owns them
  listeners.Append(new Progress(depth));
  work.gtest_ok = RUN_ALL_TESTS() == 0;
  return to_wire(work);
}

/// The tests of a process that did not live to tell of them.
void tell_lost(TestsDone& done, const Board& board, std::uint8_t worker, int signal) {
  const auto tests = all_tests();
  std::string last;
  for (std::size_t k = 0; k < board.size(); ++k) {
    if (board.has(k, worker)) last = std::string(tests[k]->test_suite_name()) + "." + tests[k]->name();
  }
  done.problems.push_back(last + ": ended its process" +
                          (signal == 0 ? std::string() : " by signal " + std::to_string(signal)) +
                          "; what that had run is lost (--jobs 1 runs everything in one)");
}

}  // namespace

Result<TestsDone> run_in_workers(int jobs, Depth depth) {
  const auto board = Board::make(all_tests().size());
  if (!board) return board.error();
  std::vector<Child> children;
  for (int worker = 0; worker < jobs; ++worker) {
    auto child = Child::start([&, worker] { return work_text(*board, static_cast<std::uint8_t>(worker), depth); });
    if (!child) return child.error();
    children.push_back(std::move(child).value());
  }
  bool told = false;
  const auto pass_on = [&] {
    if (told || !cli::stop_requested()) return;
    told = true;  // a second time would end them at once
    for (const Child& child : children) child.stop();
  };
  TestsDone done;
  std::vector<NumberedRun> runs;
  for (std::size_t worker = 0; worker < children.size(); ++worker) {
    const Child::Ended ended = children[worker].wait(pass_on);
    if (!ended.well) {
      tell_lost(done, *board, static_cast<std::uint8_t>(worker), ended.signal);
      continue;
    }
    WorkDone work = from_wire(ended.text);
    done.gtest_ok = done.gtest_ok && work.gtest_ok;
    for (NumberedRun& run : work.tests) runs.push_back(std::move(run));
  }
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
  for (NumberedRun& run : runs) {
    for (Exhibit& exhibit : run.exhibits) adopt(std::move(exhibit));
    done.tests.push_back(std::move(run.run));
  }
  return done;
}

}  // namespace etendue::validation
