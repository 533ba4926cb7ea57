#ifndef ROLLGAIT_TESTS_REFERENCE_CHECK_FAMILIES_H_
#define ROLLGAIT_TESTS_REFERENCE_CHECK_FAMILIES_H_

#include "tests/reference_check/reader.h"
#include "tests/reference_check/report.h"

namespace rollgait::reference {

// One kind of reference file: how it is told from the others, and how every quantity in it is computed and compared.
struct Family {
  const char* name;
  bool (*recognises)(const Document& document);
  void (*check)(const Document& document, Report* report);
};

// The table of families (families.cc). A file belongs to the first that recognises it.
extern const Family kFamilies[];
extern const int kFamilyCount;

// True if the document is an object whose first entry of "cases" has the field `input` and, in its "expect", the field
// `expected`.
bool FirstCaseHas(const Document& document, const std::string& input, const std::string& expected);

// Checks every entry of "cases" of a file that holds besides them only "description" and "digits".
void CheckCases(const Document& document, void (*check)(Fields item, Report* report), Report* report);

// One line per family, defined in the file of that name.
bool IsEllipsoidPlane(const Document& document);
void CheckEllipsoidPlane(const Document& document, Report* report);
bool IsEllipsoidPair(const Document& document);
void CheckEllipsoidPair(const Document& document, Report* report);
bool IsRollingDerivatives(const Document& document);
void CheckRollingDerivatives(const Document& document, Report* report);
bool IsSuperellipsoidPlane(const Document& document);
void CheckSuperellipsoidPlane(const Document& document, Report* report);
bool IsBallAnalytic(const Document& document);
void CheckBallAnalytic(const Document& document, Report* report);
bool IsMovingPlane(const Document& document);
void CheckMovingPlane(const Document& document, Report* report);
bool IsPassiveWalkers(const Document& document);
void CheckPassiveWalkers(const Document& document, Report* report);
bool IsRattleback(const Document& document);
void CheckRattleback(const Document& document, Report* report);
bool IsTriaxial(const Document& document);
void CheckTriaxial(const Document& document, Report* report);

}  // namespace rollgait::reference

#endif  // ROLLGAIT_TESTS_REFERENCE_CHECK_FAMILIES_H_
