#pragma once
// What somebody chooses by hand about a file of another program: texts of fields and meanings of columns, to
// import settings and back, and what the file is with them.

#include "sim/io/import/foreign_facts.h"
#include "sim/io/import/import_settings.h"

#include <QString>
#include <QStringList>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::desktop {

struct ImportChoices {
  std::map<std::string, std::string> meanings; ///< column -> quantity, "" leaves it out; those chosen alone
  QString length, time, mass;                  ///< units of the file: "mm"; empty: SI
  QString radius, radiusOf;                    ///< "1.5 mm"; "1 = 1 mm, 2 = 2 mm"
  QString lower, upper;                        ///< three lengths with commas; both or neither
  QString periodic;                            ///< "xy", "none"; empty: as the file says
  QString timeStep, frameInterval;
  QString shape; ///< as in ImportSettings
  QStringList walls;
};

/// Of settings at hand, for the columns of the file.
ImportChoices choicesOf(const ImportSettings& settings, const ForeignFacts& facts);
/// Throws InputError with every fault found. `base` gives what cannot be chosen here.
ImportSettings settingsOf(const ImportChoices& choices, const ImportSettings& base);

/// A quantity in words: "position along x".
QString quantityInWords(const std::string& quantity);

/// What the file is with these settings: a sentence, what is missing yet, and what is taken for granted.
struct ImportTrial {
  QString sentence;
  QStringList missing, granted;
};
/// Reads the frame that `facts` are of. Throws InputError.
ImportTrial tryImport(const ForeignFacts& facts, const ImportSettings& settings);

/// Where settings lie so that the path finds them: FILE.import.toml; for a pattern import.toml in its folder.
std::filesystem::path importFileFor(const std::filesystem::path& path, const ForeignFacts& facts);

} // namespace sandglass::desktop
