#include "granum/spray/nozzle.hpp"

#include "granum/law/droplet/size.hpp"

#include <algorithm>
#include <cmath>

namespace granum::spray
{
namespace
{
struct OnAxis
{
    double along, across;  //!< m
};

OnAxis on_axis(Nozzle const& nozzle, Vec3 const& x)
{
    Vec3 const from = x - nozzle.position;
    double const along = math::dot(from, nozzle.direction);
    return {along, math::norm(from - along * nozzle.direction)};
}

//! Two unit vectors that make a right-handed frame with `axis`.
std::array<Vec3, 2> frame(Vec3 const& axis)
{
    Vec3 const helper = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    Vec3 first = math::cross(helper, axis);
    first = first / math::norm(first);
    return {first, math::cross(axis, first)};
}
}

double Nozzle::diameter(base::Random& random) const
{
    return sizes ? sizes->mass_diameter(random.uniform())
                 : law::droplet::sample_volume_weighted(median, spread, random.normal());
}

double Nozzle::largest_diameter() const
{
    return sizes ? sizes->mass_diameter(1 - 3e-5) : law::droplet::sample_volume_weighted(median, spread, 4);
}

double Nozzle::jet_speed(Vec3 const& x, double density) const
{
    auto const [z, r] = on_axis(*this, x);
    if (z <= 0 || air_mass_flow <= 0) return 0;
    double const centre = std::min(air_velocity, 7.0 * std::sqrt(momentum() / density) / z);
    double const width = half_width(z);
    return centre * std::exp(-std::log(2.0) * r * r / (width * width));
}

double Nozzle::source_weight(Vec3 const& x, double cell) const
{
    auto const [z, r] = on_axis(*this, x);
    double const width = std::max(0.75 * cell, half_width(std::max(z, 0.0)));
    double const length = 2 * cell;
    double const middle = 0.5 * length;
    double const along = std::abs(z - middle) / length;
    if (along >= 1 || r > 3 * width) return 0;
    return (1 - along) * std::exp(-std::log(2.0) * r * r / (width * width));
}

std::vector<Droplet> Nozzle::emit(double now, double dt, Liquid const& liquid, std::uint32_t seed) const
{
    std::vector<Droplet> out;
    if (rate <= 0) return out;
    // Parcel number n leaves at (n + 0.5) / parcels_per_second: the count does not depend on the steps taken.
    auto const left_by = [this](double t) {
        return static_cast<std::uint64_t>(std::max(0.0, std::floor(t * parcels_per_second + 0.5)));
    };
    auto const [right, up] = frame(direction);
    double const parcel_mass = rate / parcels_per_second;
    for (std::uint64_t n = left_by(now); n < left_by(now + dt); ++n) {
        Droplet droplet{.id = n + (number << 40)};
        base::Random random(seed, base::Purpose::droplet, droplet.id, 0);
        double const mass = liquid.density * math::pi / 6 * std::pow(diameter(random), 3);
        droplet.solute = mass * liquid.solids_fraction;
        droplet.water = mass - droplet.solute;
        if (liquid.melt()) droplet.molten = droplet.solute;
        droplet.weight = parcel_mass / mass;
        droplet.temperature = droplet_temperature;
        droplet.position = position;
        droplet.delay = std::clamp((static_cast<double>(n) + 0.5) / parcels_per_second - now, 0.0, dt);
        double const cosine = 1 - random.uniform() * (1 - std::cos(half_angle));
        double const sine = std::sqrt(1 - cosine * cosine), turn = 2 * math::pi * random.uniform();
        droplet.velocity =
            droplet_velocity * (cosine * direction + sine * (std::cos(turn) * right + std::sin(turn) * up));
        out.push_back(droplet);
    }
    return out;
}
}
