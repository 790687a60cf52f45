// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <sstream>

#include "etendue/form_factor/catalogue/catalogue.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"

namespace etendue::validation {
namespace {

// CLAIM      The drawings of all entries are those in docs/catalogue, which were looked at.
// ORACLE     the files, byte by byte. A guard against changes that nobody meant; it proves nothing.
// TOLERANCE  none.
TEST(Catalogue, DrawsWhatItsPageShows) {
  proves({}, Oracle::exact, "90 drawings, byte by byte");
  for (const catalogue::Entry& entry : catalogue::entries()) {
    std::ostringstream shown;
    shown
        << std::ifstream(source_root() / "docs/catalogue" / (std::string(entry.id) + ".svg"), std::ios::binary).rdbuf();
    EXPECT_TRUE(holds(shown.str() == catalogue::svg(entry))) << entry.id << ": ci/catalogue writes docs/catalogue anew";
  }
}

}  // namespace
}  // namespace etendue::validation
