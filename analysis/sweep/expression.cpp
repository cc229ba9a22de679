#include "analysis/sweep/expression.h"

#include "sim/base/error.h"

#include <fmt/format.h>
#include <muParser.h>

#include <numbers>

namespace sandglass::analysis {

double evaluate(const std::string& expression, const std::map<std::string, double>& numbers) {
  std::map<std::string, double> values = numbers; // muParser wants places that it could write to
  std::string names;
  try {
    mu::Parser parser;
    parser.DefineConst("pi", std::numbers::pi);
    for (auto& [name, value] : values) {
      parser.DefineVar(name, &value);
      names += (names.empty() ? "" : ", ") + name;
    }
    parser.SetExpr(expression);
    const double result = parser.Eval();
    if (values != numbers)
      throw InputError(fmt::format("\"{}\" assigns with '='; write == to compare", expression));
    return result;
  } catch (const mu::ParserError& e) {
    throw InputError(fmt::format("\"{}\" is no expression of {}: {}", expression,
                                 names.empty() ? "numbers" : names, e.GetMsg()));
  }
}

} // namespace sandglass::analysis
