// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "etendue/core/result.hpp"

// The register of claims as data: what the two source documents state, and what has been shown about it.
namespace etendue::validation {

/// The verdict of one row, as the register states it; a run confirms or contradicts it.
enum class Verdict {
  open,          ///< not shown yet
  verified,      ///< holds as printed
  refuted,       ///< wrong or ambiguous as printed; the mended form holds
  proved,        ///< errata only: the printed form fails and the mended one holds
  not_testable,  ///< claims only: no test could decide it, for the reason that the row gives
};
std::string_view name(Verdict verdict);

/// One statement of a source document.
struct Claim {
  std::string id;
  std::string source;   ///< "[IU] 2.5"
  std::string subject;  ///< "local reflection"
  std::string statement;
  std::string formula;  ///< plain text, may be empty
  Verdict verdict = Verdict::open;
  std::vector<std::string> errata;  ///< that mend it
  std::string reason;               ///< why it is not testable; else empty
};

/// One mistake, or one missing guard, of a source document.
struct Erratum {
  std::string id;
  std::string source;
  std::string printed;
  std::string right;
  std::string tells_apart;
  Verdict verdict = Verdict::open;
};

struct Register {
  std::vector<Claim> claims;
  std::vector<Erratum> errata;

  const Claim* find_claim(std::string_view id) const;
  const Erratum* find_erratum(std::string_view id) const;
  bool knows(std::string_view id) const { return find_claim(id) || find_erratum(id); }
};

/// Refuses bad JSON, unknown keys, missing fields, repeated ids, verdict words that do not fit, and errata that are
/// named by a claim but have no row; the message names the row.
[[nodiscard]] Result<Register> parse_register(std::string_view claims_json, std::string_view errata_json);

/// validation/claims/{claims,errata}.json as they were when the program was built.
std::string_view embedded_claims();
std::string_view embedded_errata();

}  // namespace etendue::validation
