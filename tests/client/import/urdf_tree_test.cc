// URDF files that must be refused, each with file, element and reason, and what is read of a good one.
#include "client/import/urdf_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>

#include "client/failure.h"
#include "client/import/tree_file.h"
#include "client/import/xml_guard.h"
#include "tests/client/import/broken_file.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

constexpr char kHead[] = "<robot name=\"r\">\n";
constexpr char kLinks[] = "<link name=\"a\"/><link name=\"b\"/>";
constexpr char kGoodJoint[] =
    "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 1 0\"/>"
    "<limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"5\"/></joint>";

std::string Robot(const std::string& body) { return kHead + body + "</robot>\n"; }
std::string Inertial(const std::string& mass, const std::string& moments) {
  return "<link name=\"a\"><inertial><mass value=\"" + mass + "\"/><inertia " + moments + "/></inertial></link>";
}
std::vector<BrokenFile> BrokenUrdfFiles() {
  const std::string good = Robot(std::string(kLinks) + kGoodJoint);
  const std::string unit = "ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"";
  std::string deep, many, chain = kLinks;
  for (int i = 0; i < 200; ++i) deep += "<x>";
  for (int i = 0; i < 1001; ++i) many += "<link name=\"l" + std::to_string(i) + "\"/>";
  std::string attributes = "<link name=\"a\"";
  for (int i = 0; i < 300000; ++i) attributes += " a" + std::to_string(i) + "=\"\"";
  return {
      {"Empty", "", "is no XML"},
      {"NoXml", "solid cube\nfacet normal 0 0 1\n", "x.urdf"},
      {"Truncated", good.substr(0, good.size() / 2), "is no XML"},
      {"Xacro", "<xacro><link name=\"a\"/></xacro>", "root element is <xacro>, must be <robot>"},
      {"EntityBomb",
       "<?xml version=\"1.0\"?>\n<!DOCTYPE lolz [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b "
       "\"&a;&a;&a;&a;&a;&a;&a;&a;\">]>\n" +
           Replaced(good, "name=\"r\"", "name=\"&b;\""),
       "x.urdf:2: has a document type or entity declaration"},
      {"ExternalEntity", "<!DOCTYPE r SYSTEM \"http://127.0.0.1/evil.dtd\">" + good, "document type"},
      {"MillionLinks", Robot(std::string(1000000, '<')), "at most 100000 are accepted"},
      {"ThousandAndOneLinks", Robot(many), "<link name=\"l1000\">: is one of more than 1000"},
      {"Deep", Robot(deep), "x.urdf:2: elements are nested deeper than 64"},
      {"ZeroByte", Robot(std::string("<link name=\"a\"/>") + '\0'), "holds a zero byte"},
      {"NoName", Robot("<link/>"), "<link> of <robot name=\"r\">: needs the attribute name"},
      {"LongName", Robot("<link name=\"" + std::string(5000, 'n') + "\"/>"), "name has 5000 bytes"},
      {"NoUtf8", Robot("<link name=\"a\xff\"/>"), "x.urdf:2: <link>: name is no UTF-8"},
      {"Surrogate", Robot("<link name=\"&#xD800;\"/>"), "name is no UTF-8"},
      {"CutCharacter", Replaced(good, "parent link=\"a\"", "parent link=\"\xc3\""),
       "<parent> of <joint name=\"j\">: link is no UTF-8"},
      {"ControlCharacters", Replaced(good, "revolute", "ball\x1b[2J\x7f"), "type \"ball?[2J?\" is unknown"},
      {"SameLinkTwice", Robot("<link name=\"a\"/><link name=\"a\"/>"), "<link name=\"a\">: the name is used twice"},
      {"SameJointTwice", Robot(std::string(kLinks) + kGoodJoint + kGoodJoint),
       "<joint name=\"j\">: the name is used twice"},
      {"NoLinks", Robot(""), "<robot name=\"r\">: has no <link>"},
      {"TwoRoots", Robot(kLinks), "\"a\" and \"b\"; connect them by a joint"},
      {"UnknownParent", Replaced(good, "parent link=\"a\"", "parent link=\"ghost\""),
       "x.urdf:2: <joint name=\"j\">: names the link \"ghost\", which the file does not have"},
      {"NoParent", Replaced(good, "<parent link=\"a\"/>", ""), "<joint name=\"j\">: needs an element <parent>"},
      {"OwnParent", Replaced(good, "parent link=\"a\"", "parent link=\"b\""), "cycle"},
      {"Cycle",
       Robot(kLinks + std::string(kGoodJoint) +
             Replaced(Replaced(Replaced(kGoodJoint, "\"a\"", "\"c\""), "\"b\"", "\"a\""), "\"j\"", "\"k\"") +
             Replaced(Replaced(Replaced(kGoodJoint, "\"a\"", "\"d\""), "\"b\"", "\"c\""), "\"j\"", "\"m\"") +
             Replaced(Replaced(Replaced(kGoodJoint, "\"b\"", "\"d\""), "\"a\"", "\"b\""), "\"j\"", "\"n\"") +
             "<link name=\"c\"/><link name=\"d\"/>"),
       "is part of a cycle"},
      {"ClosedChain", Robot(std::string(kLinks) + kGoodJoint + Replaced(kGoodJoint, "\"j\"", "\"k\"")),
       "<joint name=\"k\">: the link \"b\" is also the child of joint \"j\""},
      {"NotANumber", Replaced(good, "0 1 0", "0 nan 0"),
       "<axis> of <joint name=\"j\">: xyz has nan; numbers must be finite"},
      {"Infinite", Replaced(good, "upper=\"1\"", "upper=\"inf\""), "upper has inf; numbers must be finite"},
      {"Overflow", Replaced(good, "upper=\"1\"", "upper=\"1e999\""), "upper has 1e999"},
      {"Huge", Replaced(good, "effort=\"10\"", "effort=\"1e12\""),
       "effort has 1e12; numbers must be finite and within"},
      {"Word", Replaced(good, "upper=\"1\"", "upper=\"one\""), "upper has \"one\", which is no number"},
      {"Formula", Replaced(good, "upper=\"1\"", "upper=\"${pi/2}\""), "upper has \"${pi/2}\", which is no number"},
      {"TwoNumbers", Replaced(good, "0 1 0", "0 1"), "xyz has 2 numbers, must have 3"},
      {"NoLimit", Replaced(good, "<limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"5\"/>", ""),
       "needs an element <limit>"},
      {"EmptyRange", Replaced(good, "lower=\"-1\"", "lower=\"2\""), "lower must be below upper"},
      {"NegativeDamping", Replaced(good, "</joint>", "<dynamics damping=\"-1\"/></joint>"),
       "<joint name=\"j\">: its damping is -1; must be at least 0"},
      {"NegativeEffort", Replaced(good, "effort=\"10\"", "effort=\"-10\""), "its effort limit is negative"},
      {"NoAxis", Replaced(good, "0 1 0", "0 0 0"), "its axis has length 0"},
      {"UnknownType", Replaced(good, "revolute", "ball"), "type \"ball\" is unknown"},
      {"NegativeMass", Robot(Inertial("-1", unit)), "<link name=\"a\">: its mass is -1 kg"},
      {"MassOfAPlanet", Robot(Inertial("6e8", unit)), "must be in [0, 1e6] kg"},
      {"NoMass", Robot(Replaced(Inertial("1", unit), "<mass value=\"1\"/>", "")),
       "<inertial> of <link name=\"a\">: needs an element <mass>"},
      {"InertiaWithoutMass", Robot(Inertial("0", unit)), "its mass is 0, but its inertia is not"},
      {"NegativeInertia", Robot(Inertial("1", Replaced(unit, "iyy=\"1\"", "iyy=\"-1\""))),
       "has the principal moment -1 kg m²; none may be negative"},
      {"Indefinite", Robot(Inertial("1", Replaced(unit, "ixy=\"0\"", "ixy=\"5\""))), "none may be negative"},
      {"MissingMoment", Robot(Inertial("1", Replaced(unit, "izz=\"1\"", ""))), "needs the attribute izz"},
      {"Millimetres", Replaced(good, "<axis", "<origin xyz=\"0 0 -432\"/><axis"), "these look like millimetres"},
      {"MillimetreShape",
       Replaced(good, "<link name=\"b\"/>",
                "<link name=\"b\"><collision><geometry><box size=\"220 100 60\"/></geometry></collision></link>"),
       "<link name=\"b\">: the size of a shape"},
      {"FlatBox",
       Replaced(good, "<link name=\"b\"/>",
                "<link name=\"b\"><collision><geometry><box size=\"1 1 0\"/></geometry></collision></link>"),
       "has a size <= 0"},
      {"ManyAttributes", Robot(attributes + "/>"), "x.urdf:2: a tag has more than 64 attributes"},
      {"ManyAttributesBehindQuotes", Robot("<x a='>' b=\"<\"" + attributes.substr(14) + "/>"),
       "more than 64 attributes"},
  };
}

class BrokenUrdfTest : public testing::TestWithParam<BrokenFile> {};
INSTANTIATE_TEST_SUITE_P(Files, BrokenUrdfTest, testing::ValuesIn(BrokenUrdfFiles()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(BrokenUrdfTest, IsRefusedWithFileElementAndReason) { ExpectRefused("x.urdf", GetParam()); }

// The largest file that is accepted for parsing takes a bounded time and memory.
TEST(UrdfTreeTest, LargeFilesTakeBoundedMemory) {
  std::string body = "<link name=\"a\"/>";
  while (body.size() < (size_t{3} << 20)) body += "<t a=\"\" b=\"\" c=\"\" d=\"\" e=\"\" f=\"\" g=\"\" h=\"\"/>";
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  const LinkTree tree = ReadLinkTreeText("x.urdf", Robot(body));
  getrusage(RUSAGE_SELF, &after);
  EXPECT_EQ(tree.links.size(), 1u);
  EXPECT_THAT(tree.left_out, testing::ElementsAre("elements that are not part of a body: <t>"));
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 150 * 1024) << "kB";
}

TEST(UrdfTreeTest, DepthCountsOpenElementsOnly) {
  const auto nested = [](int depth) {
    std::string text = "<link name=\"a\"/>";
    for (int i = 0; i < 200; ++i) text += "<x></x><x/><x a='/'/>";
    for (int i = 1; i < depth; ++i) text += "<x>";
    for (int i = 1; i < depth; ++i) text += "</x>";
    return Robot(text);
  };
  EXPECT_EQ(ReadLinkTreeText("x.urdf", nested(kMaxXmlDepth)).links.size(), 1u);
  EXPECT_THROW(ReadLinkTreeText("x.urdf", nested(kMaxXmlDepth + 1)), Failure);
}

TEST(UrdfTreeTest, AFileThatIsTooLargeIsNotParsed) {
  const std::string path = testing::TempDir() + "large.urdf";
  std::ofstream(path) << Robot(std::string(5 << 20, ' '));
  try {
    ReadLinkTree(path);
    FAIL() << "read";
  } catch (const Failure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("large.urdf: has more than 4 MiB"));
  }
  EXPECT_THROW(ReadLinkTree(testing::TempDir() + "no_such.urdf"), Failure);
  EXPECT_THROW(ReadLinkTree(testing::TempDir()), Failure);
  EXPECT_THROW(ReadLinkTree("/dev/zero"), Failure);
}

// Paths and addresses in a URDF are text: a file that names a pipe nobody writes to is read at once.
TEST(UrdfTreeTest, OpensNothingThatTheFileNames) {
  const std::string mesh =
      "<visual><geometry><mesh filename=\"file:///dev/tty\"/></geometry><material name=\"m\">"
      "<texture filename=\"http://127.0.0.1:1/t.png\"/></material></visual>"
      "<collision><geometry><mesh filename=\"/dev/zero\"/></geometry></collision>";
  const LinkTree tree = ReadLinkTreeText("x.urdf", Robot("<link name=\"a\">" + mesh + "</link>"));
  EXPECT_TRUE(tree.links[0].shapes.empty());
  ASSERT_EQ(tree.left_out.size(), 1u);
  EXPECT_THAT(tree.left_out[0], HasSubstr("1 collision shapes that are no box, sphere or cylinder"));
}

TEST(UrdfTreeTest, ReadsDampingAndTellsThatFrictionIsLeftOut) {
  const std::string good = Robot(std::string(kLinks) + kGoodJoint);
  const LinkTree damped = ReadLinkTreeText("x.urdf", Replaced(good, "</joint>", "<dynamics damping=\"0.7\"/></joint>"));
  EXPECT_EQ(damped.joints[0].damping, 0.7);
  EXPECT_TRUE(damped.left_out.empty());
  const LinkTree rubbing =
      ReadLinkTreeText("x.urdf", Replaced(good, "</joint>", "<dynamics friction=\"0.7\"/></joint>"));
  EXPECT_EQ(rubbing.joints[0].damping, 0);
  EXPECT_THAT(rubbing.left_out, testing::ElementsAre("friction of 1 joints, which a model does not have"));
}

TEST(UrdfTreeTest, ReadsNumbersAndOrder) {
  const LinkTree tree = ReadLinkTreeText(
      "x.urdf",
      Robot("<joint name=\"far\" type=\"fixed\"><parent link=\"b\"/><child link=\"c\"/><origin xyz=\"1\t2\n3\" rpy=\"0 "
            "0 1.5707963267948966\"/></joint>" +
            std::string(kGoodJoint) +
            "<link name=\"c\"><inertial><origin xyz=\"+0.5 0 0\" rpy=\"0 0 1.5707963267948966\"/><mass value=\"2\"/>"
            "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"2\" iyz=\"0\" izz=\"2.5\"/></inertial>"
            "<collision><geometry><cylinder radius=\"0.1\" length=\"0.4\"/></geometry></collision></link>" +
            kLinks));
  ASSERT_EQ(tree.joints.size(), 2u);
  EXPECT_EQ(tree.joints[0].name, "j") << "parents come first";
  EXPECT_EQ(tree.joints[1].name, "far");
  EXPECT_EQ(tree.links[static_cast<size_t>(tree.root)].name, "a");
  EXPECT_EQ(tree.joints[1].origin.position, Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((tree.joints[1].origin.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_EQ(tree.joints[0].axis, Eigen::Vector3d::UnitY());
  EXPECT_EQ(tree.joints[0].effort_max, 10);
  EXPECT_EQ(tree.joints[0].velocity, 5);
  EXPECT_EQ(tree.joints[0].upper, 1);
  const TreeLink& c = tree.links[static_cast<size_t>(tree.FindLink("c"))];
  EXPECT_EQ(c.mass.mass, 2);
  EXPECT_EQ(c.mass.center, Eigen::Vector3d(0.5, 0, 0));
  EXPECT_NEAR(c.mass.inertia(0, 0), 2, 1e-15) << "turned into the axes of the link";
  EXPECT_NEAR(c.mass.inertia(1, 1), 1, 1e-15);
  ASSERT_EQ(c.shapes.size(), 1u);
  EXPECT_EQ(c.shapes[0].half_size, Eigen::Vector3d(0.1, 0.1, 0.2));
}

}  // namespace
}  // namespace rollgait::client
