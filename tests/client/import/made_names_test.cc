// Names that a reader makes: those of links give way to the names of the file, those of joints are refused by the
// names that the file has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "client/failure.h"
#include "client/import/link_tree.h"
#include "client/import/mjcf_tree.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

// A trunk that moves freely as `root`, with these bodies.
LinkTree Read(const std::string& root, const std::string& bodies) {
  return ReadLinkTreeText("x.xml", "<mujoco><worldbody><body name=\"p\" pos=\"0 0 1\"><freejoint name=\"" + root +
                                       "\"/><geom size=\"0.1\"/>" + bodies + "</body></worldbody></mujoco>");
}

std::string Body(const std::string& attributes, const std::string& joints) {
  return "<body " + attributes + ">" + joints + "<geom size=\"0.1\"/></body>";
}

std::string Joint(const std::string& name, const std::string& type) {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"/>";
}

void ExpectRefused(const std::string& root, const std::string& bodies, const std::string& why) {
  try {
    Read(root, bodies);
    ADD_FAILURE() << "is not refused: " << bodies;
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr(why));
  }
}

TEST(MadeNamesTest, LinksGiveWay) {
  const std::string chain = Body("name=\"a\"", Joint("s", "ball")), hinges = Joint("h", "hinge") + Joint("i", "slide");
  for (const std::string& bodies :
       {chain + Body("name=\"s_x_link\"", Joint("j", "hinge")), Body("name=\"s_y_link\"", Joint("j", "hinge")) + chain,
        Body("name=\"a\"", hinges) + Body("name=\"h_link\"", Joint("j", "hinge")) +
            Body("name=\"h_link_\"", Joint("k", "hinge")),
        Body("", Joint("j", "hinge")) + Body("name=\"body_2\"", Joint("k", "hinge")),
        Body("name=\"body_3\"", Joint("j", "hinge")) + Body("", Joint("k", "hinge"))}) {
    const LinkTree tree = Read("root", bodies);
    std::set<std::string> names;
    for (const TreeLink& link : tree.links)
      EXPECT_TRUE(names.insert(link.name).second) << link.name << " in " << bodies;
  }
}

TEST(MadeNamesTest, LinksOfTheFileKeepTheirs) {
  const LinkTree tree =
      Read("root", Body("name=\"a\"", Joint("s", "ball")) + Body("name=\"s_x_link\"", Joint("j", "hinge")));
  int named = 0;
  for (const TreeLink& link : tree.links) {
    if (link.name != "s_x_link") continue;
    EXPECT_FALSE(link.is_made);
    ++named;
  }
  EXPECT_EQ(named, 1);
}

TEST(MadeNamesTest, TurnsAreRefusedWithTheirJoint) {
  const std::string ball = Body("name=\"a\"", Joint("s", "ball")),
                    turn = "and so is called one of the three turns of the joint \"s\"";
  ExpectRefused("root", ball + Body("name=\"b\"", Joint("s_z", "hinge")),
                "<joint name=\"s_z\">: the name is used twice, " + turn);
  ExpectRefused("root", Body("name=\"b\"", Joint("s_y", "slide")) + ball,
                "<joint name=\"s_y\">: the name is used twice, " + turn);
  ExpectRefused("s_x", ball, "\"s_x\">: the name is used twice, " + turn);
}

TEST(MadeNamesTest, TwoBallsOfOneNameAreRefusedByIt) {
  ExpectRefused("root", Body("name=\"a\"", Joint("s", "ball")) + Body("name=\"b\"", Joint("s", "ball")),
                "<joint name=\"s\">: the name is used twice; give each its own");
}

}  // namespace
}  // namespace rollgait::client
