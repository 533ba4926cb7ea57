// An MJCF that a reader of frames, units and inertias can get wrong.
#ifndef ROLLGAIT_TESTS_SUPPORT_TWISTED_BODY_H_
#define ROLLGAIT_TESTS_SUPPORT_TWISTED_BODY_H_

#include <Eigen/Geometry>

namespace rollgait::client {

// Every form of orientation, every solid with fromto and without, several joints on a body with anchors of their own,
// sizes that are partly inherited, a body of numbers among bodies of geoms, extrinsic angles.
inline constexpr char kTwistedBody[] = R"(<mujoco model="twisted">
  <compiler angle="radian" eulerseq="XzY" settotalmass="40"/>
  <default>
    <geom size="0.1 0.05 0.07" density="800"/>
    <default class="thin"><geom type="cylinder" size="0.02"/></default>
  </default>
  <worldbody>
    <body name="base" pos="0.3 0.2 1" axisangle="1 2 3 0.8">
      <freejoint/>
      <geom type="box" pos="0.1 0 0.2" euler="0.3 0.2 0.1"/>
      <geom type="ellipsoid" size="0.2" pos="0 0.1 0" zaxis="1 1 1"/>
      <geom type="sphere" mass="2" pos="0 0.05 0.4"/>
      <body name="thigh" pos="0 0.1 -0.1" xyaxes="1 0.2 0 0 1 0.3">
        <joint name="hip" type="hinge" axis="0.6 0.8 0" pos="0.01 0.02 0.03" ref="0.3"/>
        <joint name="twist" axis="0 0 2" pos="0 0 -0.1"/>
        <geom type="capsule" fromto="0 0 0 0.1 0.05 -0.3" size="0.06"/>
        <geom class="thin" pos="0.1 0 0" quat="0.9 0.1 0.2 0.3"/>
        <body name="shank" pos="0.05 0 -0.35" euler="0.1 0.2 0.3">
          <inertial pos="0 0.01 -0.15" mass="1.5" diaginertia="0.02 0.025 0.01" euler="0.2 0 0.4"/>
          <joint name="knee" axis="0 1 0" pos="0 0 0.02"/>
          <geom type="box" fromto="0 0 0 0.1 0.05 -0.3" size="0.04 0.03"/>
          <body name="slider" pos="0 0 -0.3" zaxis="0.1 0.2 1">
            <joint name="slide" type="slide" ref="0.07" axis="1 0.5 0" range="-0.5 0.5" limited="true"/>
            <geom type="ellipsoid" fromto="0 0 0 0.1 0.05 -0.1" size="0.04"/>
            <geom type="cylinder" fromto="0 0 0 0.1 0 0.1" size="0.03" mass="0.4"/>
          </body>
        </body>
      </body>
      <body name="arm" pos="0 -0.2 0.3">
        <joint name="swing" axis="1 0 0.5"/>
        <geom class="thin" type="capsule"/>
        <body name="tool" pos="0.1 0 0" quat="2 0 1 0">
          <geom type="sphere" size="0.05"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="hip" gear="-30" ctrlrange="-1 2" ctrllimited="true"/>
    <general joint="twist" gainprm="40" ctrlrange="-1 1" ctrllimited="true" forcerange="-25 90" forcelimited="true"/>
    <position joint="knee" kp="100" gear="2" forcerange="-10 20" forcelimited="true"/>
    <motor joint="slide" gear="9" ctrlrange="-1 1" ctrllimited="true"/>
    <motor joint="slide" gear="1" ctrlrange="-1 1" ctrllimited="true"/>
    <motor joint="swing" gear="5" ctrlrange="-1 1" ctrllimited="true"/>
  </actuator>
</mujoco>)";

inline Eigen::Matrix3d TwistedUpright() {
  return Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_SUPPORT_TWISTED_BODY_H_
