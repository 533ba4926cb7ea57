// A URDF that a reader of frames can get wrong.
#ifndef ROLLGAIT_TESTS_SUPPORT_TWISTED_ROBOT_H_
#define ROLLGAIT_TESTS_SUPPORT_TWISTED_ROBOT_H_

namespace rollgait::client {

// Turned frames everywhere: a fixed joint at the root, a locked one within a chain, a prismatic and a continuous one.
inline constexpr char kTwistedRobot[] = R"(<robot name="twisted">
  <link name="base"><inertial><origin xyz="0.1 0 0.2" rpy="0.3 0.2 0.1"/><mass value="5"/>
    <inertia ixx="0.3" ixy="0.01" ixz="0.02" iyy="0.25" iyz="-0.01" izz="0.2"/></inertial></link>
  <link name="head"><inertial><origin xyz="0 0.05 0.1"/><mass value="2"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.025"/></inertial></link>
  <link name="camera"/>
  <link name="thigh"><inertial><origin xyz="0.02 0 -0.2" rpy="0 0.4 0"/><mass value="3"/>
    <inertia ixx="0.05" ixy="0" ixz="0.003" iyy="0.05" iyz="0" izz="0.01"/></inertial></link>
  <link name="motor"><inertial><origin xyz="0 0.03 0"/><mass value="0.7"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.0015"/></inertial></link>
  <link name="shank"><inertial><origin xyz="0 0 -0.15"/><mass value="1.5"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.002"/></inertial></link>
  <link name="slider"><inertial><origin xyz="0.01 0.02 0.03"/><mass value="0.4"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
  <joint name="neck" type="fixed"><parent link="base"/><child link="head"/><origin xyz="0 0 0.4" rpy="0.5 -0.3 0.7"/></joint>
  <joint name="mount" type="fixed"><parent link="head"/><child link="camera"/><origin xyz="0.1 0 0" rpy="1 0 0"/></joint>
  <joint name="hip" type="revolute"><parent link="base"/><child link="thigh"/><origin xyz="0 0.1 -0.1" rpy="0.2 0 -0.4"/>
    <axis xyz="0.6 0.8 0"/><limit lower="-1" upper="2" effort="50" velocity="8"/></joint>
  <joint name="twist" type="revolute"><parent link="thigh"/><child link="motor"/><origin xyz="0 0 -0.3" rpy="0 0.6 0"/>
    <axis xyz="0 0 2"/><limit lower="-1" upper="1" effort="20" velocity="8"/></joint>
  <joint name="knee" type="continuous"><parent link="motor"/><child link="shank"/><origin xyz="0.05 0 -0.1" rpy="0 0 0.2"/>
    <axis xyz="0 1 0"/><limit effort="40" velocity="9"/></joint>
  <joint name="slide" type="prismatic"><parent link="shank"/><child link="slider"/><origin xyz="0 0 -0.3" rpy="0.1 0 0"/>
    <axis xyz="1 0 0"/><limit lower="-0.1" upper="0.3" effort="100" velocity="1"/></joint>
</robot>)";

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_SUPPORT_TWISTED_ROBOT_H_
