// SPDX-License-Identifier: Apache-2.0
#include "runner/selection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "runner/probe.hpp"

namespace etendue::validation {

namespace {

using Names = std::set<std::string>;

bool any_of(const std::vector<std::string>& names, const std::function<bool(const std::string&)>& fit) {
  return std::any_of(names.begin(), names.end(), fit);
}

std::string joined(const Names& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// The folders of validation/ that hold each test, outer ones first: its modules.
std::map<std::string, Names> modules() {
  std::map<std::string, Names> result;
  const auto& unit = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < unit.total_test_suite_count(); ++s) {
    const auto& suite = *unit.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      Names& folders = result[std::string(suite.name()) + "." + suite.GetTestInfo(t)->name()];
      for (const auto& part : std::filesystem::path(suite.GetTestInfo(t)->file()).parent_path()) {
        if (part == "validation")
          folders.clear();
        else
          folders.insert(part.string());
      }
    }
  }
  return result;
}

/// The claims of a subject, and their errata.
Names claims_of(const Register& all, const std::string& subject) {
  Names ids;
  for (const auto& claim : all.claims) {
    if (claim.subject != subject) continue;
    ids.insert(claim.id);
    ids.insert(claim.errata.begin(), claim.errata.end());
  }
  return ids;
}

Error unknown_subject(const Register& all, const std::string& subject, const std::map<std::string, Names>& folders) {
  Names subjects, every_folder;
  for (const auto& claim : all.claims) subjects.insert(claim.subject);
  for (const auto& [test, names] : folders) every_folder.insert(names.begin(), names.end());
  return Error{ErrorCode::usage, "--subject " + subject +
                                     ": no subject of the register and no module of the tests; subjects: " +
                                     joined(subjects) + "; modules: " + joined(every_folder)};
}

/// One choice among the tests: what it says of each, and what to say where it selects none.
struct Choice {
  std::function<bool(const TestClaims&)> fits;
  Error nothing;
};

Result<std::vector<Choice>> choices(const Options& options, const Register& all) {
  std::vector<Choice> result;
  for (const auto& pattern : options.filters) {
    result.push_back({[&pattern](const TestClaims& test) {
                        return fits(test.test, pattern) ||
                               any_of(test.claims, [&](const auto& id) { return fits(id, pattern); });
                      },
                      {ErrorCode::usage, "no test proves or is called " + pattern + "; --list names all"}});
  }
  for (const auto& claim : options.claims) {
    if (!all.knows(claim))
      return Error{ErrorCode::usage, "--claim " + claim + ": the register does not have it; --claims names all"};
    result.push_back(
        {[&claim](const TestClaims& test) { return any_of(test.claims, [&](const auto& id) { return id == claim; }); },
         {ErrorCode::usage, "--claim " + claim + ": no test proves it"}});
  }
  const auto folders = modules();
  for (const auto& subject : options.subjects) {
    const Names ids = claims_of(all, subject);
    result.push_back({[ids, folders, &subject](const TestClaims& test) {
                        return folders.at(test.test).count(subject) != 0 ||
                               any_of(test.claims, [&](const auto& id) { return ids.count(id) != 0; });
                      },
                      unknown_subject(all, subject, folders)});
  }
  return result;
}

}  // namespace

Result<std::string> gtest_filter(const Options& options, const Register& all) {
  const auto chosen = choices(options, all);
  if (!chosen) return chosen.error();
  if (chosen->empty()) return std::string();
  const auto tests = probe_tests();
  if (!tests) return tests.error();
  Names selected;
  for (const auto& choice : *chosen) {
    bool any = false;
    for (const auto& test : *tests) {
      if (!choice.fits(test)) continue;
      selected.insert(test.test);
      any = true;
    }
    if (!any) return choice.nothing;
  }
  std::string filter;
  for (const auto& test : selected) filter += (filter.empty() ? "" : ":") + test;
  return filter;
}

std::vector<std::string> command_tests() {
  std::vector<std::string> names;
  for (const auto& [test, folders] : modules()) {
    if (folders.count("cli") != 0) names.push_back(test);
  }
  return names;
}

std::string choice_text(const Options& options) {
  std::string text;
  for (const auto& pattern : options.filters) text += " --filter '" + pattern + "'";
  for (const auto& claim : options.claims) text += " --claim '" + claim + "'";
  for (const auto& subject : options.subjects) text += " --subject '" + subject + "'";
  return text + (options.deep ? " --long" : options.all ? " --all" : "");
}

}  // namespace etendue::validation
