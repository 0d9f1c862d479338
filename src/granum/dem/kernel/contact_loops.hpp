// The vectorised loops over contacts and granules. Included by one source per instruction set, see lanes.hpp.
#include "granum/dem/kernel/kernel.hpp"
#include "granum/dem/kernel/lanes.hpp"

#include <array>

namespace granum::dem::GRANUM_KERNEL
{
namespace
{
using namespace kernel;
using law::contact::Approach;
using law::contact::Pair;
using math::Triple;

struct Partner
{
    Triple<Lanes> position, velocity, spin;
    Lanes radius, inverse_mass, rounder;
    std::uint32_t const* rows;
    Addresses body;

    HWY_INLINE Partner(Body const* bodies, std::uint32_t const* which)
        : rows(which), body(const_cast<double*>(bodies->position), sizeof(Body), which)
    {
        Lanes quad[4];
        gather_quads(body, 0, quad);
        position = {quad[0], quad[1], quad[2]}, radius = quad[3];
    }
    HWY_INLINE void look()
    {
        Lanes quad[4];
        gather_quads(body, 4, quad);
        velocity = {quad[0], quad[1], quad[2]}, inverse_mass = quad[3];
        gather_quads(body, 8, quad);
        spin = {quad[0], quad[1], quad[2]}, rounder = quad[3];
    }
    // Adds to the sums of these rows, in multiples of their quanta.
    HWY_INLINE void give(Sum* sums, Triple<Lanes> const& force, Triple<Lanes> const& torque) const
    {
        auto const rounded = [](Triple<Lanes> const& a, Lanes by) {
            return Triple<Lanes>{(a.x + by) - by, (a.y + by) - by, (a.z + by) - by};
        };
        add_pulls(Addresses(sums->force, sizeof(Sum), rows), rounded(force, rounder),
                  rounded(torque, rounder * power_of_two_below(radius)));
    }
};

// Of a sphere about a point of its surface.
HWY_INLINE Lanes inverse_inertia(Partner const& granule)
{
    return granule.inverse_mass * reciprocal(Lanes(1.4) * granule.radius * granule.radius);
}

HWY_INLINE Triple<Lanes> kept(Mask m, Triple<Lanes> const& a)
{
    Lanes const zero = 0.0;
    return {select(m, a.x, zero), select(m, a.y, zero), select(m, a.z, zero)};
}

// What the laws need about each lane's pairing of materials.
class Pairings
{
  public:
    HWY_INLINE explicit Pairings(Rules const& rules, std::uint8_t const* material) : rules_(rules), material_(material)
    {
        std::size_t const all[width] = {};
        common_ = mix(all);
    }
    HWY_INLINE Pair<Lanes> const& operator()(std::uint32_t const* low, std::uint32_t const* high)
    {
        if (material_ == nullptr) return common_;
        std::size_t which[width];
        for (std::size_t lane = 0; lane < width; ++lane)
            which[lane] = material_[low[lane]] * rules_.materials + material_[high[lane]];
        return mix(which);
    }
    HWY_INLINE Pair<Lanes> const& with_walls(std::uint32_t const* rows, std::uint8_t const* walls)
    {
        std::size_t which[width];
        for (std::size_t lane = 0; lane < width; ++lane)
            which[lane] = (material_ ? material_[rows[lane]] : 0) * rules_.materials + walls[lane];
        return mix(which);
    }

  private:
    HWY_INLINE Pair<Lanes> const& mix(std::size_t const* which)
    {
        static_assert(sizeof(Pair<double>) == Pair<double>::size * sizeof(double));
        alignas(64) double values[width];
        std::size_t at = 0;
        mixed_.visit([&](Lanes& member) {
            for (std::size_t lane = 0; lane < width; ++lane)
                values[lane] = reinterpret_cast<double const*>(rules_.pairs + which[lane])[at];
            member = load(values);
            ++at;
        });
        return mixed_;
    }
    Rules const& rules_;
    std::uint8_t const* material_;
    Pair<Lanes> common_, mixed_;
};

// One, or one half where another rank owns a partner and counts the other.
HWY_INLINE Lanes shares(std::uint32_t const* low, std::uint32_t const* high, std::size_t owned)
{
    alignas(64) double share[width];
    for (std::size_t lane = 0; lane < width; ++lane) share[lane] = low[lane] < owned && high[lane] < owned ? 1.0 : 0.5;
    return load(share);
}

// One contact per lane on its way to the laws and back. It goes through memory, so that only the laws themselves, and
// not the loops around them, are compiled for each of their combinations.
struct Staged
{
    Pair<Lanes> const* pair;
    Approach<Lanes> at;
    Triple<Lanes> n, velocity, spin;  // of the first partner against the second, at the contact
    Mask touch;
    double* history;
    // Answers, on the first partner:
    Triple<Lanes> force, tangential, rolling;
    Lanes dissipated, elastic;
};

template <class Normal, class Tangential, class Rolling, bool Ledger>
HWY_FLATTEN void laws_of(Rules const& rules, Staged& contact)
{
    constexpr std::size_t columns = Tangential::history + Rolling::history + (Ledger ? 2 : 0);
    auto const& normal_law = *static_cast<Normal const*>(rules.normal);
    auto const& tangential_law = *static_cast<Tangential const*>(rules.tangential);
    auto const& rolling_law = *static_cast<Rolling const*>(rules.rolling);
    auto const& pair = *contact.pair;
    auto const at = contact.at;
    auto const n = contact.n;
    Lanes history[columns + 1];
    for (std::size_t c = 0; c < columns; ++c) history[c] = load(contact.history + c * block);
    Lanes stiffness = 0.0, stored = 0.0;
    if constexpr (Ledger) stiffness = history[columns - 2];
    auto const normal = normal_law(pair, at);
    auto const slide = tangential_law(pair, at, normal, n, contact.velocity - at.speed * n, history, stored, stiffness);
    auto const roll = rolling_law(pair, at, normal, n, contact.spin, history + Tangential::history);
    contact.tangential = kept(contact.touch, slide.force);
    contact.rolling = kept(contact.touch, roll.torque);
    contact.force = kept(contact.touch, mul_add(normal.force, n, slide.force));
    if constexpr (Ledger) {
        // The speed at the end of the step, where the force is: half a step more of this contact's acceleration.
        Lanes const speed = at.speed + Lanes(0.5) * at.step * normal.force * at.inverse_mass;
        stored += roll.energy;
        contact.dissipated =
            (normal.elastic - normal.force) * speed * at.step + slide.work + roll.work + history[columns - 1] - stored;
        contact.elastic = normal.energy + stored;
        history[columns - 2] = stiffness, history[columns - 1] = stored;
    }
    Lanes const zero = 0.0;
    for (std::size_t c = 0; c < columns; ++c)
        store(select(contact.touch, history[c], zero), contact.history + c * block);
}

using law::contact::NormalLaws;
using law::contact::RollingLaws;
using law::contact::TangentialLaws;
using Laws = void (*)(Rules const&, Staged&);

// Every combination of laws, without and with the ledger.
template <class... Normal, class... Tangential, class... Rolling>
constexpr auto every_combination(base::TypeList<Normal...>, base::TypeList<Tangential...>, base::TypeList<Rolling...>)
{
    std::array<Laws, 2 * sizeof...(Normal) * sizeof...(Tangential) * sizeof...(Rolling)> table{};
    std::size_t at = 0;
    auto const rolling = [&]<class N, class T>() {
        ((table[at++] = laws_of<N, T, Rolling, false>, table[at++] = laws_of<N, T, Rolling, true>), ...);
    };
    auto const tangential = [&]<class N>() { (rolling.template operator()<N, Tangential>(), ...); };
    (tangential.template operator()<Normal>(), ...);
    return table;
}

constexpr auto combinations = every_combination(NormalLaws{}, TangentialLaws{}, RollingLaws{});

Laws chosen(Rules const& rules)
{
    std::size_t const place =
        (rules.normal_index * TangentialLaws::size + rules.tangential_index) * RollingLaws::size + rules.rolling_index;
    return combinations[2 * place + (rules.ledger ? 1 : 0)];
}

// What a pass adds up.
struct Energy
{
    Lanes coarse = 0.0, fine = 0.0;

    HWY_INLINE void add(Lanes energy, Lanes coarse_by, Lanes fine_by)
    {
        Lanes const rough = (energy + coarse_by) - coarse_by;
        coarse += rough;
        fine += ((energy - rough) + fine_by) - fine_by;
    }
    double value() const { return sum(coarse) + sum(fine); }
};

struct Tally
{
    Lanes worst, coarse_by, fine_by;
    Energy dissipated, elastic;
    long contacts = 0;

    HWY_INLINE Tally(Rules const& rules, Seen const& seen)
        : worst(seen.largest_overlap), coarse_by(rules.coarse_energy), fine_by(rules.fine_energy)
    {
    }
    HWY_INLINE void overlap(Mask touch, Lanes overlap, Lanes radius)
    {
        Mask const worse = touch & (overlap > worst * radius);
        if (any(worse)) worst = select(worse, overlap / radius, worst);
    }
    // A contact that ended leaves what its springs had stored.
    HWY_INLINE void ended(Mask over, Lanes share, double const* stored)
    {
        dissipated.add(select(over, share * load(stored), Lanes(0.0)), coarse_by, fine_by);
    }
    HWY_INLINE void energies(Staged const& contact, Lanes share)
    {
        dissipated.add(select(contact.touch, share * contact.dissipated, Lanes(0.0)), coarse_by, fine_by);
        elastic.add(select(contact.touch, share * contact.elastic, Lanes(0.0)), coarse_by, fine_by);
    }
    void tell(Seen& seen) const
    {
        alignas(64) double each[block];
        store(worst, each);
        for (std::size_t lane = 0; lane < width; ++lane)
            if (each[lane] > seen.largest_overlap) seen.largest_overlap = each[lane];
        seen.contacts += contacts;
        seen.dissipated += dissipated.value();
        seen.elastic += elastic.value();
    }
};

// Clears the histories of lanes that touched before and do not any more.
HWY_INLINE void forget(unsigned before, double* history, std::size_t columns)
{
    if ((before & ((1u << width) - 1)) == 0) return;
    for (std::size_t c = 0; c < columns; ++c) store(Lanes(0.0), history + c * block);
}

HWY_FLATTEN void pairs(PairPass const& in, Seen& seen)
{
    Rules const& rules = *in.rules;
    auto const laws = chosen(rules);
    std::size_t const columns = rules.columns;
    Pairings pairings(rules, in.material);
    Lanes const shift = rules.lever_shift;
    Tally tally(rules, seen);
    Staged contact;
    contact.at.step = in.dt;
    contact.at.inertia = 1.0;
    for (std::size_t b = 0; b < in.blocks; ++b) {
        unsigned const before = in.touching[b];
        unsigned now = 0;
        for (std::size_t s = 0; s < block; s += width) {
            auto const* rows_low = in.pairs[b].low + s;
            auto const* rows_high = in.pairs[b].high + s;
            double* const history = in.history + b * columns * block + s;
            Partner low(in.bodies, rows_low), high(in.bodies, rows_high);
            Triple<Lanes> apart = low.position - high.position;
            if (in.image != nullptr) {
                alignas(64) double by[3][block];
                for (std::size_t lane = 0; lane < width; ++lane)
                    for (std::size_t d = 0; d < 3; ++d) by[d][lane] = in.shifts[in.image[b * block + s + lane]][d];
                apart = apart + Triple<Lanes>{load(by[0]), load(by[1]), load(by[2])};
            }
            // Rounded as in the plain loops to the last bit: the overlap is what little is left of the distance.
            Lanes const distance2 = apart.x * apart.x + (apart.y * apart.y + apart.z * apart.z);
            Lanes const reach = low.radius + high.radius;
            Mask const touch = distance2 < reach * reach;
            unsigned const bits = touch.bits();
            if (rules.ledger && (before >> s & ~bits & ((1u << width) - 1)) != 0)
                tally.ended(!touch, shares(rows_low, rows_high, in.owned), history + (columns - 1) * block);
            if (bits == 0) {
                forget(before >> s, history, columns);
                continue;
            }
            now |= bits << s;
            tally.contacts += __builtin_popcount(bits);
            low.look();
            high.look();
            Lanes const distance = exact_sqrt(distance2);
            Triple<Lanes> const n = reciprocal(distance) * apart;
            Lanes const smaller = min(low.radius, high.radius);
            // Lanes that do not touch compute something harmless and are dropped.
            Lanes const overlap = select(touch, reach - distance, Lanes(1e-3) * smaller);
            tally.overlap(touch, overlap, smaller);
            Lanes const lever_low = low.radius - shift * overlap, lever_high = high.radius - shift * overlap;
            Triple<Lanes> const velocity =
                low.velocity - high.velocity - cross(lever_low * low.spin + lever_high * high.spin, n);
            // 1/(a b) gives both quotients with one division.
            Lanes const inverse_mass = low.inverse_mass + high.inverse_mass;
            Lanes const inverse_both = reciprocal(reach * inverse_mass);
            contact.pair = &pairings(rows_low, rows_high);
            contact.at.overlap = overlap;
            contact.at.radius = low.radius * high.radius * (inverse_both * inverse_mass);
            contact.at.mass = inverse_both * reach;
            contact.at.inverse_mass = inverse_mass;
            if (rules.inertia) contact.at.inertia = reciprocal(inverse_inertia(low) + inverse_inertia(high));
            contact.at.speed = dot(velocity, n);
            contact.n = n;
            contact.velocity = velocity;
            contact.spin = low.spin - high.spin;
            contact.touch = touch;
            contact.history = history;
            laws(rules, contact);

            Triple<Lanes> const turn = cross(n, contact.tangential);
            low.give(in.sums, contact.force, contact.rolling - lever_low * turn);
            high.give(in.sums, -contact.force, -contact.rolling - lever_high * turn);
            if (rules.ledger) tally.energies(contact, shares(rows_low, rows_high, in.owned));
        }
        in.touching[b] = static_cast<std::uint8_t>(now);
    }
    tally.tell(seen);
}

HWY_FLATTEN void walls(WallPass const& in, Seen& seen)
{
    Rules const& rules = *in.rules;
    auto const laws = chosen(rules);
    std::size_t const columns = rules.columns;
    Pairings pairings(rules, in.material);
    Lanes const zero = 0.0, shift = rules.lever_shift;
    Tally tally(rules, seen);
    Staged contact;
    contact.at.step = in.dt;
    contact.at.inertia = 1.0;
    auto const triple = [](double const* const* from, std::size_t place) {
        return Triple<Lanes>{load(from[0] + place), load(from[1] + place), load(from[2] + place)};
    };
    auto const keep = [](Triple<Lanes> const& what, double* const* to, std::size_t place) {
        store(what.x, to[0] + place), store(what.y, to[1] + place), store(what.z, to[2] + place);
    };
    for (std::size_t b = 0; b < in.blocks; ++b) {
        unsigned const before = in.touching[b];
        unsigned now = 0;
        for (std::size_t s = 0; s < block; s += width) {
            std::size_t const place = b * block + s;
            double* const history = in.history + b * columns * block + s;
            Lanes overlap = load(in.overlap + place);
            Mask const touch = overlap > zero;
            unsigned const bits = touch.bits();
            if (rules.ledger && (before >> s & ~bits & ((1u << width) - 1)) != 0)
                tally.ended(!touch, Lanes(1.0), history + (columns - 1) * block);
            if (bits == 0) {
                forget(before >> s, history, columns);
                keep({zero, zero, zero}, in.force, place);
                keep({zero, zero, zero}, in.torque, place);
                continue;
            }
            now |= bits << s;
            tally.contacts += __builtin_popcount(bits);
            Partner granule(in.bodies, in.row + place);
            granule.look();
            Triple<Lanes> const n = triple(in.normal, place);
            overlap = select(touch, overlap, Lanes(1e-3) * granule.radius);
            tally.overlap(touch, overlap, granule.radius);
            Lanes const lever = granule.radius - shift * overlap;
            Triple<Lanes> const velocity =
                granule.velocity - triple(in.velocity, place) - lever * cross(granule.spin, n);
            contact.pair = &pairings.with_walls(in.row + place, in.wall_material + place);
            contact.at.overlap = overlap;
            contact.at.radius = granule.radius;
            contact.at.mass = reciprocal(granule.inverse_mass);
            contact.at.inverse_mass = granule.inverse_mass;
            if (rules.inertia) contact.at.inertia = reciprocal(inverse_inertia(granule));
            contact.at.speed = dot(velocity, n);
            contact.n = n;
            contact.velocity = velocity;
            contact.spin = granule.spin - triple(in.spin, place);
            contact.touch = touch;
            contact.history = history;
            laws(rules, contact);

            Triple<Lanes> const torque = contact.rolling - lever * cross(n, contact.tangential);
            granule.give(in.sums, contact.force, torque);
            keep(contact.force, in.force, place);
            keep(torque, in.torque, place);
            if (rules.ledger) tally.energies(contact, Lanes(1.0));
        }
        in.touching[b] = static_cast<std::uint8_t>(now);
    }
    tally.tell(seen);
}

void look(Look& in, Span const* spans, std::size_t count)
{
    Lanes const x = in.at[0], y = in.at[1], z = in.at[2], own = in.own_radius, skin = in.skin, close = in.close;
    bool const periodic = in.length[0] + in.length[1] + in.length[2] > 0;
    auto const shortest = [&in](Lanes difference, std::size_t d) {
        Lanes const length = in.length[d], half = in.half[d];
        return difference - select(difference > half, length, select(difference < -half, -length, Lanes(0.0)));
    };
    std::size_t near = 0, far = 0;
    for (std::size_t s = 0; s < count; ++s)
        for (std::size_t k = spans[s].begin; k < spans[s].end; k += width) {
            Lanes dx = x - load_anywhere(in.x + k), dy = y - load_anywhere(in.y + k), dz = z - load_anywhere(in.z + k);
            if (periodic) dx = shortest(dx, 0), dy = shortest(dy, 1), dz = shortest(dz, 2);
            Lanes const distance2 = dx * dx + (dy * dy + dz * dz), reach = own + load_anywhere(in.radius + k);
            Lanes const limit = reach + skin, nearly = reach + close;
            unsigned found = (distance2 < limit * limit).bits();
            if (spans[s].end - k < width) found &= (1u << (spans[s].end - k)) - 1;
            if (found == 0) continue;
            unsigned const nearest = (distance2 < nearly * nearly).bits();
            for (; found != 0; found &= found - 1) {
                auto const lane = static_cast<unsigned>(__builtin_ctz(found));
                auto const place = static_cast<std::uint32_t>(k + lane);
                bool const is_near = (nearest >> lane & 1) != 0;
                in.near[near] = in.far[far] = place;
                near += is_near;
                far += !is_near;
            }
        }
    in.near_count = near;
    in.far_count = far;
}

template <int Kicks, bool Drifts>
HWY_FLATTEN void move_rows(Motion const& in, MotionSeen& seen)
{
    // Four numbers at a time: the fourth of a velocity is the inverse mass, of a spin the rounder, of a position the
    // radius, and what is added to them is zero.
    hn::CappedTag<double, 4> const d;
    std::size_t const lanes = hn::Lanes(d);
    alignas(32) double const pull[4] = {in.gravity[0], in.gravity[1], in.gravity[2], 0};
    alignas(32) double const drift[4] = {in.drift, in.drift, in.drift, 0};
    auto const half = hn::Set(d, in.half), none = hn::Zero(d);
    for (std::size_t c = 0; c < 4; c += lanes) {
        auto const gravity = hn::Load(d, pull + c), along = hn::Load(d, drift + c);
        auto fastest = none, odd = none;
        for (std::size_t row = 0; row < in.rows; ++row) {
            Body& body = in.bodies[row];
            Sum& sum = in.sums[row];
            auto const acceleration = hn::MulAdd(hn::Load(d, sum.force + c), hn::Set(d, body.inverse_mass), gravity);
            auto const turning = hn::Set(d, in.half * 2.5 * body.inverse_mass / (body.radius * body.radius));
            auto velocity = hn::Load(d, body.velocity + c), spin = hn::Load(d, body.spin + c);
            auto const torque = hn::Load(d, sum.torque + c);
            for (int kick = 0; kick < Kicks; ++kick) {
                velocity = hn::MulAdd(half, acceleration, velocity);
                spin = hn::MulAdd(turning, torque, spin);
            }
            hn::Store(spin, d, body.spin + c);
            if constexpr (Drifts) {
                hn::Store(hn::MulAdd(along, velocity, hn::Load(d, body.position + c)), d, body.position + c);
                auto const square = hn::Mul(velocity, velocity);
                fastest = hn::Max(fastest, square);
                odd = hn::MulAdd(hn::Add(square, spin), none, odd);  // zero as long as all is finite
            }
            hn::Store(velocity, d, body.velocity + c);
            if (in.clear) hn::Store(none, d, sum.force + c), hn::Store(none, d, sum.torque + c);
        }
        if constexpr (Drifts) {
            alignas(32) double each[4], miss[4];
            hn::Store(fastest, d, each), hn::Store(odd, d, miss);
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                if (c + lane < 3) seen.fastest2 += each[lane];
                seen.finite = seen.finite && miss[lane] == 0;
            }
        }
    }
}

void move(Motion const& in, MotionSeen& seen)
{
    if (in.kicks == 0)
        move_rows<0, true>(in, seen);
    else if (in.kicks == 2)
        move_rows<2, true>(in, seen);
    else if (in.drift != 0)
        move_rows<1, true>(in, seen);
    else
        move_rows<1, false>(in, seen);
}
}
}
