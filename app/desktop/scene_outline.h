#pragma once
// A scene file as a form: its tables with every key that they may have, from the same descriptions by which
// it is read. Knows where in the text each value stands, so that the form changes values and nothing else:
// comments and order stay.

#include "sim/scene/parameters.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sandglass::desktop {

struct SceneField {
  std::string path;     ///< as messages name it: "species.bead.size.diameter"
  ParameterSpec spec;   ///< description, unit, choices
  bool selects = false; ///< chooses a kind, on which the keys beside it depend
  bool given = false;
  std::string text;               ///< TOML of the value when given
  std::size_t begin = 0, end = 0; ///< bytes of the value, or of the place where the key would be inserted
  std::size_t lineBegin = 0;      ///< where the key begins
  bool inlineTable = false;       ///< the key stands between braces
  bool aloneThere = false;        ///< of an inline table without keys
};

struct SceneTable {
  std::string path;        ///< "species.bead", "contact.glass-wall.normal"; "" for the top of the file
  std::string title;       ///< "species bead", "contact glass-wall: normal"
  std::string description; ///< of the kind chosen; may be empty
  std::vector<SceneField> fields;
};

/// Throws InputError with line and reason when the text is no TOML.
std::vector<SceneTable> outlineScene(const std::string& text);

/// The text with another value for a field of its outline; an empty value takes the key out.
std::string withValue(const std::string& text, const SceneField& field, const std::string& toml);

/// The text with another kind chosen at `path`; keys beside it that the new kind does not have are taken out.
/// Throws InputError like outlineScene().
std::string withKind(const std::string& text, const std::string& path, const std::string& kind);

/// A value as a form shows it: without quotes and brackets ("3 mm", "0, -9.81 m/s^2, 0").
std::string shownValue(const std::string& toml, const ParameterSpec& spec);
/// And back. What is no value stays as it is, for the reader to complain about.
std::string tomlValue(const std::string& shown, const ParameterSpec& spec);

/// The path that a message of the reader is about ("FILE:LINE: PATH is ..."), or "".
std::string pathOfFault(const std::string& sentence, const std::vector<SceneTable>& tables);

} // namespace sandglass::desktop
