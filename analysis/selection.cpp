#include "analysis/selection.h"

#include "sim/base/error.h"

#include <fmt/format.h>
#include <muParser.h>

#include <cctype>
#include <cmath>
#include <map>

namespace sandglass::analysis {

namespace {

/// muParser has no name for |spin|, since a bar is half of its "or".
constexpr const char* magnitudeOf = "magnitude_of.";

bool isNameCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// "|spin|" becomes "magnitude_of.spin"; "a || b" stays.
std::string withoutBars(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::size_t end = i + 1;
    while (text[i] == '|' && end < text.size() && isNameCharacter(text[end]))
      ++end;
    const bool isName = text[i] == '|' && end > i + 1 && end < text.size() && text[end] == '|';
    const bool isOr = (i > 0 && text[i - 1] == '|') || (end + 1 < text.size() && text[end + 1] == '|');
    if (isName && !isOr) {
      result += magnitudeOf + text.substr(i + 1, end - i - 1);
      i = end;
    } else {
      result += text[i];
    }
  }
  return result;
}

/// muParser would assign, silently.
bool assigns(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '=' && (i + 1 == text.size() || text[i + 1] != '=') &&
        (i == 0 || std::string("<>=!").find(text[i - 1]) == std::string::npos))
      return true;
  return false;
}

/// The quantities that an expression names, each looked up once.
class Quantities {
public:
  Quantities(const Frame& frame, QuantityLookup lookup) : lookup_(std::move(lookup)) {
    if (!lookup_) lookup_ = [&frame](const std::string& name) { return grainScalar(frame, name); };
  }
  double* find(const std::string& name) {
    const std::string prefix = magnitudeOf;
    const std::string quantity = name.starts_with(prefix) ? "|" + name.substr(prefix.size()) + "|" : name;
    return values_.try_emplace(name, lookup_(quantity)).first->second.data();
  }
  bool empty() const { return values_.empty(); }

private:
  QuantityLookup lookup_;
  std::map<std::string, std::vector<double>> values_;
};

mu::value_type negated(mu::value_type value) {
  return value == 0 ? 1 : 0;
}

} // namespace

std::vector<std::uint8_t> selectGrains(const Frame& frame, const std::string& expression,
                                       const QuantityLookup& lookup) {
  if (assigns(expression))
    throw InputError(fmt::format("the selection \"{}\" has a single '='; write == to compare", expression));
  std::vector<std::uint8_t> chosen(frame.size(), 0);
  Quantities quantities(frame, lookup);
  try {
    mu::Parser parser;
    parser.DefineNameChars("0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.");
    parser.DefineInfixOprt("!", negated);
    parser.SetVarFactory(
        [](const mu::char_type* name, void* found) { return static_cast<Quantities*>(found)->find(name); },
        &quantities);
    parser.SetExpr(withoutBars(expression));
    if (frame.size() == 0) return chosen; // nothing to look names up in
    if (parser.GetUsedVar().empty()) {    // a plain number: all or none
      const double value = parser.Eval();
      std::fill(chosen.begin(), chosen.end(), value != 0 && !std::isnan(value));
      return chosen;
    }
    std::vector<double> values(frame.size());
    parser.Eval(values.data(), static_cast<int>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
      chosen[i] = values[i] != 0 && !std::isnan(values[i]);
  } catch (const mu::ParserError& e) {
    throw InputError(
        fmt::format("the selection \"{}\" is no expression: {}; write a comparison such as \"z > 0.05 && "
                    "speed < 0.1\"",
                    expression, e.GetMsg()));
  }
  return chosen;
}

} // namespace sandglass::analysis
