// reference_check FILE...  computes every quantity of reference files (JSON or CSV, families.cc) with this library and
// prints, per family and field, the number of cases, the worst error and the worst error relative to its tolerance.
// Ends with 0 if all are within their tolerance, 1 if one is not, 2 if a file cannot be read or holds a field that is
// not known here.
#include <iostream>

#include "tests/reference_check/families.h"

namespace rollgait::reference {
namespace {

const Family& FamilyOf(const Document& document) {
  for (int i = 0; i < kFamilyCount; ++i) {
    if (kFamilies[i].recognises(document)) return kFamilies[i];
  }
  std::string known;
  for (int i = 0; i < kFamilyCount; ++i) known += std::string(i > 0 ? ", " : "") + kFamilies[i].name;
  throw ReadError("belongs to no family that is known here (" + known + ")");
}

int Main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: reference_check FILE...\n";
    return 2;
  }
  Report report;
  bool readable = true;
  for (int i = 1; i < argc; ++i) {
    try {
      const Document document = ReadDocument(argv[i]);
      FamilyOf(document).check(document, &report);
    } catch (const std::exception& error) {
      std::cerr << "reference_check: " << argv[i] << ": " << error.what() << "\n";
      readable = false;
    }
  }
  report.Print(std::cout);
  if (!readable) return 2;
  return report.passed() && !report.empty() ? 0 : 1;
}

}  // namespace
}  // namespace rollgait::reference

int main(int argc, char** argv) { return rollgait::reference::Main(argc, argv); }
