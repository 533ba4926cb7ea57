// Prints the sample solve as proto3 JSON, to look at a report without a server:
//   print_sample_solve solves/a -10 > a.json
#include <cstdlib>
#include <iostream>

#include "client/json.h"
#include "client/text.h"
#include "tests/client/sample_solve.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: print_sample_solve NAME SLOPE_IN_DEGREES\n";
    return 2;
  }
  std::cout << rollgait::client::ToJsonText(
      rollgait::client::SampleSolve(argv[1], std::atof(argv[2]) * rollgait::client::kPi / 180));
}
