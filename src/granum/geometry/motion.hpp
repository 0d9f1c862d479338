// How walls move: sums of simple motions, each a function of time, so that a restarted run meets the same walls.
#pragma once

#include "granum/math/vec3.hpp"

#include <array>
#include <limits>
#include <span>
#include <variant>

namespace granum::geometry
{
using math::Vec3;

//! When a motion acts; before, its wall stands where it was drawn, after, where it got to.
struct Period
{
    double start = 0;                                       //!< s
    double stop = std::numeric_limits<double>::infinity();  //!< s
};

struct Translation
{
    Vec3 velocity;  //!< m/s
    Period when{};
};

//! About a fixed axis. Shapes of revolution about this axis keep their place: only their surface moves.
struct Rotation
{
    Vec3 point;          //!< of the axis, m
    Vec3 axis{0, 0, 1};  //!< unit; positive rates turn by the right-hand rule
    double rate = 0;     //!< rad/s
    Period when{};
};

//! Displacement amplitude (sin(2 pi frequency (t - start) + phase) - sin(phase)) along `direction`.
struct Vibration
{
    Vec3 direction{0, 0, 1};  //!< unit
    double amplitude = 0;     //!< m
    double frequency = 0;     //!< Hz
    double phase = 0;         //!< rad
    Period when{};
};

//! Moves along `direction` until the granules press back with `pressure`: a piston pushed with pressure * area and
//! braked in proportion to its speed, so that it goes at `fastest` where nothing resists.
struct Servo
{
    Vec3 direction{0, 0, -1};  //!< unit, towards the granules
    double pressure = 0;       //!< wanted, Pa, above 0
    double area = 0;           //!< of the wall, m2, above 0 (see facing_area)
    double fastest = 0;        //!< m/s
    Period when{};
};

using Motion = std::variant<Translation, Rotation, Vibration, Servo>;

//! What a servo has come to; belongs in a checkpoint.
struct ServoState
{
    double travelled = 0;  //!< m along its direction
    double speed = 0;      //!< m/s, held through the step that follows
    bool operator==(ServoState const&) const = default;
};

//! The speed (m/s) of a servo in the step of `dt` (s) that follows `time` (s), when granules press on its wall with
//! `force` (N). `mass` (kg) is the piston's inertia; that of the granules it touches keeps it stable at any step that
//! is stable for them.
double servo_speed(Servo const& servo, double speed, Vec3 const& force, double mass, double time, double dt);

//! Where a rigid body is and how it moves. A point X of the body as it was drawn is now at rotation X + shift.
struct Pose
{
    std::array<Vec3, 3> rotation{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  //!< rows
    Vec3 shift;                                                                 //!< m
    Vec3 velocity;                                                              //!< of the drawn origin, m/s
    Vec3 spin;                                                                  //!< rad/s
    bool turned = false;                                                        //!< rotation is not the identity

    Vec3 to_space(Vec3 const& drawn) const;
    Vec3 to_body(Vec3 const& x) const;
    Vec3 direction_to_space(Vec3 const& drawn) const;
    //! Velocity of the surface at x (in space), m/s.
    Vec3 velocity_at(Vec3 const& x) const { return velocity + cross(spin, x - shift); }
};

//! The motions act one after the other, each about axes that stand still in space: the first listed acts on the body
//! as drawn. The first `in_place` of them are rotations that leave the shape where it is: they count for velocity and
//! spin only.
Pose pose(std::span<Motion const> motions, std::size_t in_place, double time, ServoState const& servo);
}
