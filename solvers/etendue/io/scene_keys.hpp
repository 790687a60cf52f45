// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace etendue {

/// The keys of one kind of object in a scene file. scenes/scene.schema.json has a definition of the same name, and a
/// test holds the two together.
struct KeySet {
  std::string name;
  std::vector<std::string> mandatory;
  std::vector<std::string> optional;

  std::vector<std::string> all() const;
};

/// Every kind there is; the only list of keys in the program.
const std::vector<KeySet>& scene_key_sets();

/// The kind of that name; the name must exist.
const KeySet& keys_of(const std::string& name);

/// What an object may have that is one of these kinds, but which is not known: all their keys, "type" alone mandatory.
KeySet keys_of_any(const std::vector<std::string>& names);

/// The values of "type" of objects, of lights, of patterns, of their mappings, of bumps and of highlights.
const std::vector<std::string>& object_types();
const std::vector<std::string>& light_types();
const std::vector<std::string>& pattern_types();
const std::vector<std::string>& mapping_types();
const std::vector<std::string>& bump_types();
const std::vector<std::string>& highlight_types();

}  // namespace etendue
