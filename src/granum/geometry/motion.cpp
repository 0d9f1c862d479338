#include "granum/geometry/motion.hpp"

#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
double elapsed(Period const& when, double time)
{
    return std::clamp(time, when.start, std::max(when.start, when.stop)) - when.start;
}

bool acts(Period const& when, double time)
{
    return time >= when.start && time < when.stop;
}

void slide(Pose& pose, Vec3 const& way, Vec3 const& velocity)
{
    pose.shift += way;
    pose.velocity += velocity;
}

//! Rodrigues' formula, row by row.
std::array<Vec3, 3> turn_about(Vec3 const& axis, double angle)
{
    double const c = std::cos(angle), s = std::sin(angle), rest = 1 - c;
    auto const& [x, y, z] = axis;
    return {Vec3{c + rest * x * x, rest * x * y - s * z, rest * x * z + s * y},
            Vec3{rest * x * y + s * z, c + rest * y * y, rest * y * z - s * x},
            Vec3{rest * x * z - s * y, rest * y * z + s * x, c + rest * z * z}};
}

Vec3 times(std::array<Vec3, 3> const& matrix, Vec3 const& a)
{
    return {dot(matrix[0], a), dot(matrix[1], a), dot(matrix[2], a)};
}

Vec3 transposed_times(std::array<Vec3, 3> const& matrix, Vec3 const& a)
{
    return a.x * matrix[0] + a.y * matrix[1] + a.z * matrix[2];
}

void apply(Pose& pose, Translation const& motion, bool, double time, ServoState const&)
{
    slide(pose, elapsed(motion.when, time) * motion.velocity, acts(motion.when, time) ? motion.velocity : Vec3{});
}

void apply(Pose& pose, Rotation const& motion, bool in_place, double time, ServoState const&)
{
    if (!in_place) {
        auto const turn = turn_about(motion.axis, motion.rate * elapsed(motion.when, time));
        pose.shift = motion.point + times(turn, pose.shift - motion.point);
        pose.velocity = times(turn, pose.velocity);
        pose.spin = times(turn, pose.spin);
        std::array<Vec3, 3> rotation;
        for (std::size_t row = 0; row < 3; ++row) rotation[row] = transposed_times(pose.rotation, turn[row]);
        pose.rotation = rotation;
        pose.turned = true;
    }
    if (!acts(motion.when, time)) return;
    Vec3 const spin = motion.rate * motion.axis;
    pose.velocity += cross(spin, pose.shift - motion.point);
    pose.spin += spin;
}

void apply(Pose& pose, Vibration const& motion, bool, double time, ServoState const&)
{
    double const omega = 2 * math::pi * motion.frequency, angle = omega * elapsed(motion.when, time) + motion.phase;
    double const speed = acts(motion.when, time) ? motion.amplitude * omega * std::cos(angle) : 0.0;
    slide(pose, (motion.amplitude * (std::sin(angle) - std::sin(motion.phase))) * motion.direction,
          speed * motion.direction);
}

void apply(Pose& pose, Servo const& motion, bool, double, ServoState const& servo)
{
    slide(pose, servo.travelled * motion.direction, servo.speed * motion.direction);
}
}

double servo_speed(Servo const& servo, double speed, Vec3 const& force, double mass, double time, double dt)
{
    if (!acts(servo.when, time)) return 0;
    if (!(mass > 0)) return servo.fastest;
    double const push = servo.pressure * servo.area, brake = push / servo.fastest;
    double const next = (mass * speed + dt * (push + dot(force, servo.direction))) / (mass + dt * brake);
    return std::clamp(next, -servo.fastest, servo.fastest);
}

Vec3 Pose::to_space(Vec3 const& drawn) const
{
    return direction_to_space(drawn) + shift;
}

Vec3 Pose::to_body(Vec3 const& x) const
{
    return turned ? transposed_times(rotation, x - shift) : x - shift;
}

Vec3 Pose::direction_to_space(Vec3 const& drawn) const
{
    return turned ? times(rotation, drawn) : drawn;
}

Pose pose(std::span<Motion const> motions, std::size_t in_place, double time, ServoState const& servo)
{
    Pose out;
    for (std::size_t k = 0; k < motions.size(); ++k)
        std::visit([&](auto const& motion) { apply(out, motion, k < in_place, time, servo); }, motions[k]);
    return out;
}
}
