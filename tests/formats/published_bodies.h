// Bodies that nobody here described: a file of a Debian package, and files made from published tables.
#ifndef ROLLGAIT_TESTS_FORMATS_PUBLISHED_BODIES_H_
#define ROLLGAIT_TESTS_FORMATS_PUBLISHED_BODIES_H_

#include <optional>
#include <string>
#include <vector>

namespace rollgait::client {

struct PublishedBody {
  std::string name;
  std::string file;                 // as users would name it; its ending says the format
  std::string source;               // of the numbers
  std::optional<std::string> text;  // absent: the package that has it is not installed
  double speed;                     // m/s, to walk at
};

// RABBIT, a biped of five links that stands on points: E. R. Westervelt, J. W. Grizzle, D. E. Koditschek 2003, Hybrid
// zero dynamics of planar biped walkers, IEEE Trans Automat Contr 48(1):42-56; C. Chevallereau et al. 2003, RABBIT: a
// testbed for advanced control theory, IEEE Control Syst Mag 23(5):57-79. Masses, lengths, centres of mass and moments
// of inertia are those of the robot. Its feet are balls of 2 cm, as points have no surface.
std::string RabbitUrdf();

// A person as OpenSim's gait2392: 23 degrees of freedom, oblique axes of ankle, subtalar joint and toes, knees whose
// shanks slide as they bend. Joints: S. L. Delp et al. 1990, IEEE Trans Biomed Eng 37:757-767; knees: G. T. Yamaguchi,
// F. E. Zajac 1989, J Biomech 22:1-10; masses and inertias: F. C. Anderson, M. G. Pandy 1999, Comput Methods Biomech
// Biomed Engin 2:201-231; spheres of the feet and springs of the toes: A. Falisse et al. 2019, J R Soc Interface
// 16:20190402. Optimal forces of actuators are rounded strengths of people.
std::string Gait2392Osim();

std::vector<PublishedBody> PublishedBodies();

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_FORMATS_PUBLISHED_BODIES_H_
