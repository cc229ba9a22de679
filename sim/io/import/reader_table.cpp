#include "sim/io/import/reader_table.h"

#include "sim/base/error.h"
#include "sim/io/import/lammps_binary.h"
#include "sim/io/import/lammps_dump.h"
#include "sim/io/import/npy.h"
#include "sim/io/import/pvd.h"
#include "sim/io/import/table_text.h"
#include "sim/io/import/vtkhdf.h"
#include "sim/io/import/xyz.h"

#include <fmt/format.h>

namespace sandglass {

namespace {

std::vector<ReaderKind>& kinds() {
  static std::vector<ReaderKind> all{lammpsDump(), lammpsBinary(), npy(), vtkhdf(),
                                     pvd(),        xyz(),          csv(), pointRows()};
  return all;
}

} // namespace

const std::vector<ReaderKind>& readerKinds() {
  return kinds();
}

void registerReader(ReaderKind kind) {
  for (auto& known : kinds())
    if (known.name == kind.name) return;
  kinds().insert(kinds().begin(), std::move(kind));
}

const ReaderKind& readerFor(const ImportFile& file) {
  constexpr std::size_t looked = 65536;
  std::string head = file.head(looked);
  if (head.empty()) throw InputError(fmt::format("{}: byte 0: the file is empty", file.name()));
  if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff"))
    throw InputError(
        fmt::format("{}: byte 0: the file is UTF-16 text; save it as UTF-8 or ASCII", file.name()));
  if (head.find('\n') == std::string::npos && head.find('\r') != std::string::npos &&
      head.find('\0') == std::string::npos)
    throw InputError(
        fmt::format("{}: byte {}: the lines end in carriage returns alone; save the file with the "
                    "line ends of Linux or Windows",
                    file.name(), head.find('\r')));
  if (head.starts_with("\xef\xbb\xbf")) head.erase(0, 3);
  for (const auto& kind : kinds())
    if (kind.recognises(head)) return kind;
  if (looksLikeOldLammpsBinary(head))
    throw InputError(
        fmt::format("{}: byte 0: this looks like a binary LAMMPS dump of before 2020, which does not "
                    "name its columns; turn it into text with LAMMPS' tool binary2txt, or read it "
                    "with a newer LAMMPS (rerun) and dump it again",
                    file.name()));
  for (const char* block : {"vtkMultiBlockDataSet", "vtkPartitionedDataSet", "vtkHierarchicalBoxDataSet"})
    if (head.find("<VTKFile") < 1024 && head.find(block) != std::string::npos)
      throw InputError(
          fmt::format("{}: byte {}: this is a {}, a list of other files; name the one that holds the "
                      "grains, or all of them as a pattern in quotes",
                      file.name(), head.find(block), block));
  std::string due;
  for (const auto& kind : kinds())
    due += (due.empty() ? "" : "; ") + kind.expected;
  const std::string_view first = std::string_view(head).substr(0, head.find_first_of("\r\n"));
  throw InputError(fmt::format("{}: byte 0: found {}, which begins none of the forms that can be read: {}",
                               file.name(), shownText(first), due));
}

} // namespace sandglass
