// SPDX-License-Identifier: Apache-2.0
#include "runner/register.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <set>

namespace etendue::validation {

namespace {

using Json = nlohmann::json;

constexpr std::array kVerdicts = {Verdict::open, Verdict::verified, Verdict::refuted, Verdict::proved,
                                  Verdict::not_testable};

struct BadRow {
  std::string message;
};

/// Takes fields out of one row and, at the end, refuses what nobody took.
class Row {
 public:
  Row(const Json& json, const std::string& place) : json_(json), place_(place) {
    if (!json.is_object()) throw BadRow{place + ": a row is an object"};
  }

  std::string text(const char* key, bool may_be_empty = false) {
    taken_.insert(key);
    const auto found = json_.find(key);
    if (found == json_.end() || !found->is_string()) throw BadRow{place_ + ": needs a string \"" + key + "\""};
    auto value = found->get<std::string>();
    if (value.empty() && !may_be_empty) throw BadRow{place_ + ": \"" + key + "\" is empty"};
    return value;
  }

  std::vector<std::string> texts(const char* key) {
    taken_.insert(key);
    std::vector<std::string> values;
    if (!json_.contains(key)) return values;
    if (!json_[key].is_array()) throw BadRow{place_ + ": \"" + key + "\" is a list of strings"};
    for (const auto& entry : json_[key]) {
      if (!entry.is_string()) throw BadRow{place_ + ": \"" + key + "\" is a list of strings"};
      values.push_back(entry.get<std::string>());
    }
    return values;
  }

  Verdict verdict(std::initializer_list<Verdict> allowed) {
    const std::string word = text("verdict");
    for (const Verdict verdict : kVerdicts) {
      if (name(verdict) != word) continue;
      for (const Verdict fits : allowed) {
        if (fits == verdict) return verdict;
      }
    }
    throw BadRow{place_ + ": \"" + word + "\" is not a verdict that fits here"};
  }

  void finish() const {
    for (const auto& entry : json_.items()) {
      if (!taken_.count(entry.key())) throw BadRow{place_ + ": unknown key \"" + entry.key() + "\""};
    }
  }

 private:
  const Json& json_;
  std::string place_;
  std::set<std::string> taken_;
};

const Json& rows(const Json& document, const char* key) {
  if (!document.is_object() || !document.contains(key) || !document[key].is_array()) {
    throw BadRow{std::string("needs a list \"") + key + "\""};
  }
  return document[key];
}

std::string place(const char* file, const Json& row, std::size_t index) {
  const bool named = row.is_object() && row.contains("id") && row["id"].is_string();
  return std::string(file) + ": row " + (named ? row["id"].get<std::string>() : "number " + std::to_string(index + 1));
}

Claim claim_from(const Json& json, const std::string& place) {
  Row row(json, place);
  Claim claim{row.text("id"),
              row.text("source"),
              row.text("subject"),
              row.text("statement"),
              row.text("formula", true),
              row.verdict({Verdict::open, Verdict::verified, Verdict::refuted, Verdict::not_testable}),
              row.texts("errata"),
              {}};
  if (claim.verdict == Verdict::not_testable) claim.reason = row.text("reason");
  row.finish();
  if (claim.verdict == Verdict::refuted && claim.errata.empty())
    throw BadRow{place + ": refuted, but names no erratum"};
  return claim;
}

Erratum erratum_from(const Json& json, const std::string& place) {
  Row row(json, place);
  Erratum erratum{row.text("id"),
                  row.text("source"),
                  row.text("printed"),
                  row.text("right"),
                  row.text("tells_apart", true),
                  row.verdict({Verdict::open, Verdict::proved})};
  row.finish();
  return erratum;
}

Register register_from(std::string_view claims_json, std::string_view errata_json) {
  Register all;
  std::set<std::string> ids;
  const Json errata = Json::parse(errata_json);
  for (std::size_t i = 0; i < rows(errata, "errata").size(); ++i) {
    const Json& row = errata["errata"][i];
    all.errata.push_back(erratum_from(row, place("errata.json", row, i)));
    if (!ids.insert(all.errata.back().id).second) throw BadRow{"errata.json: two rows " + all.errata.back().id};
  }
  const Json claims = Json::parse(claims_json);
  for (std::size_t i = 0; i < rows(claims, "claims").size(); ++i) {
    const Json& row = claims["claims"][i];
    all.claims.push_back(claim_from(row, place("claims.json", row, i)));
    const Claim& claim = all.claims.back();
    if (!ids.insert(claim.id).second) throw BadRow{"claims.json: two rows " + claim.id};
    for (const auto& erratum : claim.errata) {
      if (!all.find_erratum(erratum)) throw BadRow{place("claims.json", row, i) + ": no erratum " + erratum};
    }
  }
  return all;
}

template <class Rows>
auto find(const Rows& rows, std::string_view id) -> decltype(&rows[0]) {
  for (const auto& row : rows) {
    if (row.id == id) return &row;
  }
  return nullptr;
}

}  // namespace

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::open:
      return "open";
    case Verdict::verified:
      return "verified";
    case Verdict::refuted:
      return "refuted";
    case Verdict::proved:
      return "proved";
    case Verdict::not_testable:
      return "not testable";
  }
  return "unknown";
}

const Claim* Register::find_claim(std::string_view id) const {
  return find(claims, id);
}
const Erratum* Register::find_erratum(std::string_view id) const {
  return find(errata, id);
}

Result<Register> parse_register(std::string_view claims_json, std::string_view errata_json) {
  try {
    return register_from(claims_json, errata_json);
  } catch (const BadRow& bad) {
    return Error{ErrorCode::invalid_input, bad.message};
  } catch (const Json::parse_error& error) {
    return Error{ErrorCode::invalid_input, error.what()};
  }
}

}  // namespace etendue::validation
