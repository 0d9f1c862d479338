// The plain loops that the vectorised ones are tested against: one contact after the other, as it is read in a book.
#include "granum/dem/kernel/collisions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace granum::dem::kernel
{
namespace
{
using law::contact::Approach;
using law::contact::Pair;
using Vector = math::Triple<double>;

Vector vector(double const* from)
{
    return {from[0], from[1], from[2]};
}

void add(double* to, Vector const& what, double rounder)
{
    double const each[3] = {what.x, what.y, what.z};
    for (std::size_t d = 0; d < 3; ++d) to[d] += (each[d] + rounder) - rounder;
}

void give(Body& body, Vector const& force, Vector const& torque)
{
    add(body.force, force, body.rounder);
    add(body.torque, torque, body.rounder * power_of_two_below(body.radius));
}

Vector nearest_image(Vector const& apart, Images const& images)
{
    auto const along = [&images](double difference, std::size_t d) {
        double const length = images.length[d], half = images.half[d];
        return difference - (difference > half ? length : difference < -half ? -length : 0);
    };
    return {along(apart.x, 0), along(apart.y, 1), along(apart.z, 2)};
}

double surface_inertia(Body const& body)
{
    return 1.4 * body.radius * body.radius / body.inverse_mass;
}

struct Answer
{
    Vector force, tangential, rolling;
    double dissipated = 0, elastic = 0;
};

template <class Normal, class Tangential, class Rolling>
Answer laws(Rules const& rules, Pair<double> const& pair, Approach<double> const& at, Vector const& n,
            Vector const& velocity, Vector const& spin, double* history)
{
    auto const& normal_law = *static_cast<Normal const*>(rules.normal);
    auto const& tangential_law = *static_cast<Tangential const*>(rules.tangential);
    auto const& rolling_law = *static_cast<Rolling const*>(rules.rolling);
    double stored = 0, stiffness = rules.ledger ? history[rules.columns - 2] : 0;
    auto const normal = normal_law(pair, at);
    auto const slide = tangential_law(pair, at, normal, n, velocity - at.speed * n, history, stored, stiffness);
    auto const roll = rolling_law(pair, at, normal, n, spin, history + Tangential::history);
    Answer out{normal.force * n + slide.force, slide.force, roll.torque};
    if (rules.ledger) {
        double const speed = at.speed + 0.5 * at.step * normal.force / at.mass;
        stored += roll.energy;
        out.dissipated = (normal.elastic - normal.force) * speed * at.step + slide.work + roll.work +
                         history[rules.columns - 1] - stored;
        out.elastic = normal.energy + stored;
        history[rules.columns - 2] = stiffness, history[rules.columns - 1] = stored;
    }
    return out;
}

void end_contact(Rules const& rules, double* history, double share, Seen& seen)
{
    if (rules.ledger) seen.dissipated.add(rules, history[(rules.columns - 1) * block], share);
    for (std::size_t c = 0; c < rules.columns; ++c) history[c * block] = 0;
}

template <class Normal, class Tangential, class Rolling>
void pair_pass(PairPass const& in, Seen& seen)
{
    Rules const& rules = *in.rules;
    for (std::size_t b = 0; b < in.blocks; ++b)
        for (std::size_t lane = 0; lane < block; ++lane) {
            auto const i = row_of(in.pairs[b].low[lane]), j = row_of(in.pairs[b].high[lane]);
            Body &low = in.bodies[i], &high = in.bodies[j];
            double* const kept = in.history + b * rules.columns * block + lane;
            auto const bit = static_cast<std::uint8_t>(1u << lane);
            double const share = i < in.owned && j < in.owned ? 1.0 : 0.5;
            Vector apart = vector(low.position) - vector(high.position);
            apart = nearest_image(apart, in.images);
            double const distance2 = norm2(apart), reach = low.radius + high.radius;
            if (!(distance2 < reach * reach)) {
                if ((in.touching[b] & bit) != 0) end_contact(rules, kept, share, seen);
                in.touching[b] = static_cast<std::uint8_t>(in.touching[b] & ~bit);
                continue;
            }
            if (in.collisions && (in.touching[b] & bit) == 0 && in.dt > 0) collide(in, b, bit);
            in.touching[b] = static_cast<std::uint8_t>(in.touching[b] | bit);
            ++seen.contacts;
            double const distance = std::sqrt(distance2), overlap = reach - distance;
            seen.largest_overlap = std::max(seen.largest_overlap, overlap / std::min(low.radius, high.radius));
            Vector const n = (1 / distance) * apart;
            double const lever_low = low.radius - rules.lever_shift * overlap;
            double const lever_high = high.radius - rules.lever_shift * overlap;
            Vector const velocity = vector(low.velocity) - vector(high.velocity) -
                                    cross(lever_low * vector(low.spin) + lever_high * vector(high.spin), n);
            double const inertia_low = surface_inertia(low), inertia_high = surface_inertia(high);
            Approach<double> const at{.overlap = overlap,
                                      .radius = low.radius * high.radius / reach,
                                      .mass = 1 / (low.inverse_mass + high.inverse_mass),
                                      .inertia = inertia_low * inertia_high / (inertia_low + inertia_high),
                                      .speed = dot(velocity, n),
                                      .step = in.dt};
            auto const pairing = in.material ? in.material[i] * rules.materials + in.material[j] : in.pairing;
            std::array<double, 16> history{};
            for (std::size_t c = 0; c < rules.columns; ++c) history[c] = kept[c * block];
            auto const out = laws<Normal, Tangential, Rolling>(rules, rules.pairs[pairing], at, n, velocity,
                                                               vector(low.spin) - vector(high.spin), history.data());
            for (std::size_t c = 0; c < rules.columns; ++c) kept[c * block] = history[c];
            Vector const turn = cross(n, out.tangential);
            give(low, out.force, out.rolling - lever_low * turn);
            give(high, -out.force, -out.rolling - lever_high * turn);
            seen.dissipated.add(rules, out.dissipated, share);
            seen.elastic.add(rules, out.elastic, share);
        }
}

template <class Normal, class Tangential, class Rolling>
void wall_pass(WallPass const& in, Seen& seen)
{
    Rules const& rules = *in.rules;
    for (std::size_t place = 0; place < in.blocks * block; ++place) {
        std::size_t const b = place / block, lane = place % block;
        double* const kept = in.history + b * rules.columns * block + lane;
        auto const bit = static_cast<std::uint8_t>(1u << lane);
        double const overlap = in.overlap[place];
        if (!(overlap > 0)) {
            for (std::size_t d = 0; d < 3; ++d) in.force[d][place] = in.torque[d][place] = 0;
            if ((in.touching[b] & bit) != 0) end_contact(rules, kept, 1, seen);
            in.touching[b] = static_cast<std::uint8_t>(in.touching[b] & ~bit);
            continue;
        }
        if (in.collisions && (in.touching[b] & bit) == 0 && in.dt > 0) collide(in, b, bit);
        in.touching[b] = static_cast<std::uint8_t>(in.touching[b] | bit);
        ++seen.contacts;
        auto const i = row_of(in.granule[place]);
        Body& body = in.bodies[i];
        auto const wall = [place](double const* const* from) {
            return Vector{from[0][place], from[1][place], from[2][place]};
        };
        seen.largest_overlap = std::max(seen.largest_overlap, overlap / body.radius);
        Vector const n = wall(in.normal);
        double const lever = body.radius - rules.lever_shift * overlap;
        Vector const velocity = vector(body.velocity) - wall(in.velocity) - lever * cross(vector(body.spin), n);
        Approach<double> const at{.overlap = overlap,
                                  .radius = body.radius,
                                  .mass = 1 / body.inverse_mass,
                                  .inertia = surface_inertia(body),
                                  .speed = dot(velocity, n),
                                  .step = in.dt};
        auto const pairing = (in.material ? in.material[i] : 0) * rules.materials + in.wall_material[place];
        std::array<double, 16> history{};
        for (std::size_t c = 0; c < rules.columns; ++c) history[c] = kept[c * block];
        auto const out = laws<Normal, Tangential, Rolling>(rules, rules.pairs[pairing], at, n, velocity,
                                                           vector(body.spin) - wall(in.spin), history.data());
        for (std::size_t c = 0; c < rules.columns; ++c) kept[c * block] = history[c];
        Vector const torque = out.rolling - lever * cross(n, out.tangential);
        give(body, out.force, torque);
        in.force[0][place] = out.force.x, in.force[1][place] = out.force.y, in.force[2][place] = out.force.z;
        in.torque[0][place] = torque.x, in.torque[1][place] = torque.y, in.torque[2][place] = torque.z;
        seen.dissipated.add(rules, out.dissipated, 1);
        seen.elastic.add(rules, out.elastic, 1);
    }
}

// Calls what<Normal, Tangential, Rolling>() for the laws of the rules.
template <class What, class... Normal, class... Tangential, class... Rolling>
void with_laws(Rules const& rules, What&& what, base::TypeList<Normal...>, base::TypeList<Tangential...>,
               base::TypeList<Rolling...>)
{
    std::size_t normal = 0;
    auto const rolling = [&]<class N, class T>() {
        std::size_t at = 0;
        ((at++ == rules.rolling_index ? what.template operator()<N, T, Rolling>() : void()), ...);
    };
    auto const tangential = [&]<class N>() {
        std::size_t at = 0;
        ((at++ == rules.tangential_index ? rolling.template operator()<N, Tangential>() : void()), ...);
    };
    ((normal++ == rules.normal_index ? tangential.template operator()<Normal>() : void()), ...);
}

void pairs(PairPass const& in, Seen& seen)
{
    with_laws(
        *in.rules, [&]<class N, class T, class R>() { pair_pass<N, T, R>(in, seen); }, law::contact::NormalLaws{},
        law::contact::TangentialLaws{}, law::contact::RollingLaws{});
}

void walls(WallPass const& in, Seen& seen)
{
    with_laws(
        *in.rules, [&]<class N, class T, class R>() { wall_pass<N, T, R>(in, seen); }, law::contact::NormalLaws{},
        law::contact::TangentialLaws{}, law::contact::RollingLaws{});
}

// One number of a velocity or a spin, pushed by the contacts, then pulled by the gas.
double kicked(double motion, double force, Drag& gas, std::size_t d)
{
    double const pushed = motion + gas.push * force, gain = gas.pull[d] - gas.share * pushed;
    gas.given[d] += gain;
    return pushed + gain;
}

void move(Motion const& in, MotionSeen& seen)
{
    for (std::size_t k = 0; k < in.count; ++k) {
        auto const row = in.rows[k];
        Body& body = in.bodies[row];
        double const push = in.half * body.inverse_mass;
        double const turning = in.half * 2.5 * body.inverse_mass / (body.radius * body.radius);
        double speed2 = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            double &velocity = body.velocity[d], &spin = body.spin[d];
            for (int kick = 0; kick < in.kicks; ++kick) {
                velocity = in.gas ? kicked(velocity, body.force[d], in.gas[row], d)
                                  : velocity + push * body.force[d] + in.half * in.gravity[d];
                spin = in.turn ? kicked(spin, body.torque[d], in.turn[row], d) : spin + turning * body.torque[d];
            }
            body.position[d] += in.drift * velocity;
            speed2 += velocity * velocity;
            seen.finite = seen.finite && std::isfinite(velocity) && std::isfinite(spin);
            if (in.clear) body.force[d] = body.torque[d] = 0;
        }
        seen.hastiest2 = std::max(seen.hastiest2, speed2 * body.per_room2);
    }
}

void look(Look& in, Span const* spans, std::size_t count)
{
    in.near_count = in.far_count = 0;
    for (std::size_t s = 0; s < count; ++s)
        for (std::uint32_t k = spans[s].begin; k < spans[s].end; ++k) {
            Vector const apart = nearest_image({in.at[0] - in.x[k], in.at[1] - in.y[k], in.at[2] - in.z[k]}, in.images);
            double const distance2 = norm2(apart);
            double const reach = in.own_radius + in.radius[k], limit = reach + in.skin, nearly = reach + in.close;
            if (distance2 < nearly * nearly)
                in.near[in.near_count++] = k;
            else if (distance2 < limit * limit)
                in.far[in.far_count++] = k;
        }
}
}

Kernel const& scalar()
{
    static constexpr Kernel kernel{"scalar", pairs, walls, move, look};
    return kernel;
}
}
