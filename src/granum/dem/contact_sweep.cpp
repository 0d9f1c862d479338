// The laws are chosen once per pass: std::visit stands outside the loops, which are templates over the chosen laws.
#include "granum/dem/contact_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace granum::dem
{
using math::triple;
using math::vec3;
using Approach = law::contact::Approach<double>;
using Pair = law::contact::Pair<double>;

namespace
{
// Force and rolling torque on the first partner, and the energies of the step.
struct Push
{
    Vec3 tangential, normal, rolling;
    double dissipated, elastic;
};

// 1.4 m R^2: the inertia of a sphere about a point of its surface.
inline double surface_inertia(double mass, double radius)
{
    return 1.4 * mass * radius * radius;
}

// `velocity` and `spin` are those of the first against the second partner, at the contact point and in the middle of
// the last step; `n` points to the first.
template <class Normal, class Tangential, class Rolling>
inline Push push(Normal const& normal_law, Tangential const& tangential_law, Rolling const& rolling_law,
                 Pair const& pair, Approach const& at, Vec3 const& n, Vec3 const& velocity, Vec3 const& spin,
                 History& history)
{
    auto const normal = normal_law(pair, at);
    double stored = 0;
    auto const tangential = tangential_law(pair, at, normal, triple(n), triple(velocity - at.speed * n),
                                           history.slip.data(), stored, history.stiffness);
    auto const rolling = rolling_law(pair, at, normal, triple(n), triple(spin), history.rolling.data());
    // The speed at the end of the step, where the force is: half a step more of this contact's own acceleration.
    double const speed = at.speed + 0.5 * at.step * normal.force / at.mass;
    stored += rolling.energy;
    Push out{.tangential = vec3(tangential.force),
             .normal = normal.force * n,
             .rolling = vec3(rolling.torque),
             .dissipated = (normal.elastic - normal.force) * speed * at.step + tangential.work + rolling.work +
                           history.stored - stored,
             .elastic = normal.energy + stored};
    history.overlap = at.overlap;
    history.normal_force = normal.force;
    history.stored = stored;
    return out;
}
}

ContactSweep::ContactSweep(Laws const& laws, std::vector<geometry::Wall> const& walls, OverlapLimits const& limits)
    : laws_(laws), walls_(walls), limits_(limits), materials_(laws.materials.size())
{
    for (std::uint32_t a = 0; a < materials_; ++a)
        for (std::uint32_t b = 0; b < materials_; ++b) table_.push_back(laws.effective(a, b));
}

SweepResult ContactSweep::operator()(particle::Store& granules, ContactStore& contacts, double dt) const
{
    SweepResult seen;
    std::visit(
        [&](auto const& normal, auto const& tangential, auto const& rolling) {
            pairs(normal, tangential, rolling, granules, contacts, dt, seen);
            walls(normal, tangential, rolling, granules, contacts, dt, seen);
        },
        laws_.normal, laws_.tangential, laws_.rolling);
    return seen;
}

template <class Normal, class Tangential, class Rolling>
void ContactSweep::pairs(Normal const& normal_law, Tangential const& tangential_law, Rolling const& rolling_law,
                         particle::Store& granules, ContactStore& contacts, double dt, SweepResult& seen) const
{
    auto const* const x = granules.position.values.data();
    auto const* const v = granules.velocity.values.data();
    auto const* const w = granules.spin.values.data();
    auto const* const radius = granules.radius.values.data();
    auto const* const mass = granules.mass.values.data();
    auto const* const material = granules.material.values.data();
    auto* const force = granules.force.values.data();
    auto* const torque = granules.torque.values.data();
    double const lever_shift = laws_.lever == Lever::contact_point ? 0.5 : 0.0;
    std::size_t const count = contacts.pairs.size();
    for (std::size_t k = 0; k < count; ++k) {
        auto const [i, j] = contacts.pairs[k];
        Vec3 const apart = x[i] - x[j];
        double const distance2 = norm2(apart), sum = radius[i] + radius[j];
        if (!(distance2 < sum * sum)) {
            if (contacts.touching[k]) {
                double const share = i < granules.owned && j < granules.owned ? 1.0 : 0.5;
                seen.dissipated += share * contacts.history[k].stored;
                contacts.touching[k] = 0;
            }
            continue;
        }
        auto& history = contacts.history[k];
        if (!contacts.touching[k]) {
            history = {};
            contacts.touching[k] = 1;
        }
        double const distance = std::sqrt(distance2);
        double const overlap = sum - distance;
        double const smaller = std::min(radius[i], radius[j]);
        if (overlap > seen.largest_overlap * smaller) {
            seen.largest_overlap = overlap / smaller;
            if (seen.largest_overlap > limits_.stop)
                seen.failure = fmt::format("granules {} and {} overlap by {:.0f} % of a radius", granules.id[i],
                                           granules.id[j], 100 * seen.largest_overlap);
        }
        Vec3 const n = apart * (1 / distance);
        double const lever_i = radius[i] - lever_shift * overlap, lever_j = radius[j] - lever_shift * overlap;
        Vec3 const relative = v[i] - v[j] - cross(lever_i * w[i] + lever_j * w[j], n);
        double const inertia_i = surface_inertia(mass[i], radius[i]), inertia_j = surface_inertia(mass[j], radius[j]);
        Approach const at{.overlap = overlap,
                          .radius = radius[i] * radius[j] / sum,
                          .mass = mass[i] * mass[j] / (mass[i] + mass[j]),
                          .inertia = inertia_i * inertia_j / (inertia_i + inertia_j),
                          .speed = dot(relative, n),
                          .step = dt};
        auto const& pair = table_[material[i] * materials_ + material[j]];
        auto const out = push(normal_law, tangential_law, rolling_law, pair, at, n, relative, w[i] - w[j], history);
        Vec3 const total = out.normal + out.tangential, turn = cross(n, out.tangential);
        force[i] += total;
        force[j] -= total;
        torque[i] += out.rolling - lever_i * turn;
        torque[j] -= out.rolling + lever_j * turn;
        double const share = i < granules.owned && j < granules.owned ? 1.0 : 0.5;
        seen.dissipated += share * out.dissipated;
        seen.elastic += share * out.elastic;
        ++seen.contacts;
    }
}

template <class Normal, class Tangential, class Rolling>
void ContactSweep::walls(Normal const& normal_law, Tangential const& tangential_law, Rolling const& rolling_law,
                         particle::Store& granules, ContactStore& contacts, double dt, SweepResult& seen) const
{
    double const lever_shift = laws_.lever == Lever::contact_point ? 0.5 : 0.0;
    constexpr std::size_t most = 16;  // walls that one granule can be near
    std::size_t const count = contacts.wall_rows.size();
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
        auto const row = contacts.wall_rows[begin].row;
        while (end < count && contacts.wall_rows[end].row == row) ++end;
        end = std::min(end, begin + most);
        auto const& x = granules.position[row];
        double const radius = granules.radius[row];
        std::array<std::optional<geometry::Touch>, most> touches;
        for (std::size_t k = begin; k < end; ++k)
            touches[k - begin] = geometry::touch(walls_[contacts.wall_rows[k].wall].surface, x, radius);
        for (std::size_t k = begin; k < end; ++k) {
            auto const& touch = touches[k - begin];
            bool accepted = touch.has_value();
            // The end of a section counts only where the section that goes on from there is not touched itself.
            if (accepted && touch->edge)
                for (std::size_t other = begin; other < end; ++other) {
                    auto const& rival = touches[other - begin];
                    if (other == k || !rival) continue;
                    if (rival->edge && other > k) continue;  // of two equal edges the first stays
                    if (dot(rival->normal, touch->normal) > (rival->edge ? 0.99 : 0.8)) accepted = false;
                }
            auto& history = contacts.wall_history[k];
            if (!accepted) {
                if (contacts.wall_touching[k]) seen.dissipated += history.stored;
                contacts.wall_touching[k] = 0;
                continue;
            }
            if (!contacts.wall_touching[k]) {
                history = {};
                contacts.wall_touching[k] = 1;
            }
            double const overlap = radius - touch->distance;
            if (overlap > seen.largest_overlap * radius) {
                seen.largest_overlap = overlap / radius;
                if (seen.largest_overlap > limits_.stop)
                    seen.failure = fmt::format("granule {} is {:.0f} % of its radius in wall {}", granules.id[row],
                                               100 * seen.largest_overlap, contacts.wall_rows[k].wall);
            }
            double const lever = radius - lever_shift * overlap;
            Vec3 const& n = touch->normal;
            Vec3 const& spin = granules.spin[row];
            Vec3 const relative = granules.velocity[row] - lever * cross(spin, n);
            double const mass = granules.mass[row];
            Approach const at{.overlap = overlap,
                              .radius = radius,
                              .mass = mass,
                              .inertia = surface_inertia(mass, radius),
                              .speed = dot(relative, n),
                              .step = dt};
            auto const& pair =
                table_[granules.material[row] * materials_ + walls_[contacts.wall_rows[k].wall].material];
            auto const out = push(normal_law, tangential_law, rolling_law, pair, at, n, relative, spin, history);
            Vec3 const total = out.normal + out.tangential;
            granules.force[row] += total;
            granules.torque[row] += out.rolling - lever * cross(n, out.tangential);
            seen.wall_force += total;
            seen.dissipated += out.dissipated;
            seen.elastic += out.elastic;
            ++seen.contacts;
        }
    }
}
}
