#include "granum/dem/frame.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace granum::dem
{
namespace
{
void set(double* to, Vec3 const& from)
{
    to[0] = from.x, to[1] = from.y, to[2] = from.z;
}

void take_row(kernel::Body& body, particle::Store const& granules, std::size_t row, double unit_force, int power)
{
    double const radius = granules.radius[row];
    set(body.position, granules.position[row]);
    set(body.velocity, granules.velocity[row]);
    set(body.spin, granules.spin[row]);
    body.radius = radius;
    body.inverse_mass = 1 / granules.mass[row];
    // A quantum of 2^-42 of the reference force: sums are exact up to 2048 times that force, an overlap of a sixth of
    // the radius, and what is rounded away is a tenth of a millionth of a millionth of it.
    double const reference = 2 * kernel::power_of_two_below(unit_force * (power == 2 ? radius * radius : radius));
    body.rounder = 1.5 * 0x1p52 * (0x1p-42 * reference);
}
}

kernel::Images Domain::images() const
{
    kernel::Images out;
    for (std::size_t d = 0; d < 3; ++d) {
        if (!periodic[d]) continue;
        out.any = true;
        out.length[d] = upper[d] - lower[d];
        out.half[d] = 0.5 * out.length[d];
    }
    return out;
}

void Frame::wrap(Domain const& domain, std::size_t row)
{
    auto& body = bodies[row];
    for (std::size_t d = 0; d < 3; ++d) {
        double const low = domain.lower[d], high = domain.upper[d], length = high - low;
        double& x = body.position[d];
        if (!domain.periodic[d] || (x >= low && x < high)) continue;
        double const lengths = length * std::floor((x - low) / length);
        x -= lengths;
        if (!(x >= low && x < high)) x = low;  // rounding at the face
        body.built[d] -= lengths;
    }
}

void Frame::resize(std::size_t rows)
{
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() / kernel::stride - 2;
    base::require(rows <= most, "{} granules on one rank are more than the {} that it can name: take more ranks", rows,
                  most);
    bodies.resize(rows + 2);
    material.resize(rows + 2);
    id.resize(rows);
    if (!collisions.empty()) collisions.resize(rows + 2);
    for (std::size_t k = rows; k < rows + 2; ++k) {
        bodies[k] = {};
        bodies[k].position[0] = k == rows ? 1e30 : -1e30;
        bodies[k].radius = bodies[k].inverse_mass = bodies[k].rounder = 1;
        material[k] = 0;
    }
}

void Frame::take(particle::Store const& granules)
{
    owned = granules.owned;
    collisions.assign(granules.groups.collisions ? owned + 2 : 0, {});
    resize(owned);
    refresh(granules);
    for (std::size_t row = 0; row < owned; ++row) {
        id[row] = granules.id[row];
        material[row] = static_cast<std::uint8_t>(granules.material[row]);
        set(bodies[row].force, granules.force[row]);
        set(bodies[row].torque, granules.torque[row]);
    }
}

void Frame::refresh(particle::Store const& granules)
{
    for (std::size_t row = 0; row < owned; ++row) take_row(bodies[row], granules, row, unit_force, unit_power);
}

void Frame::give(particle::Store& granules)
{
    for (std::size_t row = 0; row < owned; ++row) {
        granules.position[row] = vec(bodies[row].position);
        granules.velocity[row] = vec(bodies[row].velocity);
        granules.spin[row] = vec(bodies[row].spin);
        granules.force[row] = vec(bodies[row].force);
        granules.torque[row] = vec(bodies[row].torque);
    }
    if (collisions.empty()) return;
    for (std::size_t row = 0; row < owned; ++row) {
        auto const seen = std::exchange(collisions[row], {});
        granules.collisions[row] += seen.granules.count;
        granules.collision_speed[row] += seen.granules.speed;
        granules.collision_wear[row] += seen.granules.wear;
        granules.wall_collisions[row] += seen.walls.count;
        granules.wall_collision_speed[row] += seen.walls.speed;
        granules.wall_collision_wear[row] += seen.walls.wear;
    }
}

void Frame::scale_to(Laws const& laws)
{
    // Hertz's force at a given relative overlap grows with the square of the radius, that of a linear spring with it.
    auto const largest = [&laws](double radius) {
        double out = 0;
        for (std::uint32_t a = 0; a < laws.materials.size(); ++a)
            for (std::uint32_t b = a; b < laws.materials.size(); ++b)
                std::visit(
                    [&](auto const& normal) {
                        law::contact::Approach<double> const at{
                            .overlap = 1e-3 * radius, .radius = radius, .mass = 1, .inertia = 1, .speed = 0, .step = 0};
                        out = std::max(out, normal(laws.effective(a, b), at).elastic);
                    },
                    laws.normal);
        return out;
    };
    double const one = largest(1);
    if (!(one > 0)) return;
    unit_force = one;
    unit_power = largest(2) > 3 * one ? 2 : 1;
}
}
