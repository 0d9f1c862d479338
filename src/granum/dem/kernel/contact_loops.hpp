// The vectorised loops over contacts, and of the search for them. Included by one source per instruction set, see
// lanes.hpp.
#include "granum/dem/kernel/collisions.hpp"
#include "granum/dem/kernel/kernel.hpp"
#include "granum/dem/kernel/lanes.hpp"

#include <array>
#include <type_traits>

namespace granum::dem::GRANUM_KERNEL
{
namespace
{
using namespace kernel;
using law::contact::Approach;
using law::contact::Pair;
using math::Triple;

// A granule of each lane.
struct Partner
{
    Triple<Lanes> position, velocity, spin;
    Lanes radius, inverse_mass, rounder;
    Addresses body;

    HWY_INLINE Partner(Body* bodies, std::uint32_t const* places) : body{bodies->position, places}
    {
        Lanes quad[4];
        gather_quads(body, 0, quad);
        position = {quad[0], quad[1], quad[2]}, radius = quad[3];
    }
    HWY_INLINE void look()
    {
        Lanes quad[4];
        body.forget();
        gather_quads(body, 4, quad);
        velocity = {quad[0], quad[1], quad[2]}, inverse_mass = quad[3];
        gather_quads(body, 8, quad);
        spin = {quad[0], quad[1], quad[2]}, rounder = quad[3];
    }
};

// Where the answer for a granule of each lane goes: to its force and torque, in multiples of their quanta.
struct Recipient
{
    std::uint32_t const* places;
    Lanes lever, force_rounder, torque_rounder;

    HWY_INLINE void set(Partner const& granule, Lanes arm)
    {
        places = granule.body.distance;
        lever = arm;
        force_rounder = granule.rounder;
        torque_rounder = granule.rounder * power_of_two_below(granule.radius);
    }
    HWY_INLINE Addresses sums(Body* bodies) const { return {bodies->force, places}; }
};

HWY_INLINE Rows rounded(Triple<Lanes> const& a, Lanes by)
{
    return Rows({(a.x + by) - by, (a.y + by) - by, (a.z + by) - by});
}

// Of a sphere about a point of its surface.
HWY_INLINE Lanes inverse_inertia(Partner const& granule)
{
    return granule.inverse_mass * reciprocal(Lanes(1.4) * granule.radius * granule.radius);
}

HWY_INLINE Triple<Both> kept(BothMask m, Triple<Both> const& a)
{
    Both const zero = 0.0;
    return {select(m, a.x, zero), select(m, a.y, zero), select(m, a.z, zero)};
}

HWY_INLINE void put(Triple<Both>& to, std::size_t seat, Triple<Lanes> const& what)
{
    to.x.part(seat) = what.x, to.y.part(seat) = what.y, to.z.part(seat) = what.z;
}
HWY_INLINE Triple<Lanes> get(Triple<Both>& from, std::size_t seat)
{
    return {from.x.part(seat), from.y.part(seat), from.z.part(seat)};
}

// One, or one half where another rank owns a partner and counts the other.
HWY_INLINE Lanes shares(std::uint32_t const* low, std::uint32_t const* high, std::uint32_t owned)
{
    alignas(64) double share[width];
    for (std::size_t lane = 0; lane < width; ++lane) share[lane] = low[lane] < owned && high[lane] < owned ? 1.0 : 0.5;
    return load(share);
}

// Two registers of contacts on their way to the laws and back. They go through memory, so that only the laws
// themselves, and not the loops around them, are compiled for each of their combinations; two, because what one
// computes is a long chain, of which every link waits for the one before.
struct Staged
{
    Pair<Both> pair;
    Approach<Both> at;
    Triple<Both> n, velocity, spin;  // of the first partner against the second, at the contact
    BothMask touch;
    double* history[2];
    // Answers, on the first partner:
    Triple<Both> force, tangential, rolling;
    Both dissipated, elastic;
    alignas(64) double nothing[16 * block] = {};  // history of an empty seat

    // A seat where nobody sits copies the other; nobody reads its answers.
    HWY_INLINE void leave_second_empty()
    {
        auto const copy = [](Both& both) { both.b = both.a; };
        pair.visit(copy);
        for (auto* number : {&at.overlap, &at.radius, &at.mass, &at.inverse_mass, &at.inertia, &at.speed})
            copy(*number);
        for (auto* vector : {&n, &velocity, &spin}) copy(vector->x), copy(vector->y), copy(vector->z);
        touch.b = touch.a;
        history[1] = nothing;
    }
};

template <class Normal, class Tangential, class Rolling, bool Ledger>
HWY_FLATTEN void laws_of(Rules const& rules, Staged& contact)
{
    constexpr std::size_t columns = Tangential::history + Rolling::history + (Ledger ? 2 : 0);
    static_assert(columns <= 16);
    auto const& normal_law = *static_cast<Normal const*>(rules.normal);
    auto const& tangential_law = *static_cast<Tangential const*>(rules.tangential);
    auto const& rolling_law = *static_cast<Rolling const*>(rules.rolling);
    auto const& pair = contact.pair;
    auto const at = contact.at;
    auto const n = contact.n;
    Both history[columns + 1];
    for (std::size_t c = 0; c < columns; ++c)
        history[c] = {load(contact.history[0] + c * block), load(contact.history[1] + c * block)};
    Both stiffness = 0.0, stored = 0.0;
    if constexpr (Ledger) stiffness = history[columns - 2];
    auto const normal = normal_law(pair, at);
    auto const slide =
        tangential_law(pair, at, normal, n, neg_mul_add(at.speed, n, contact.velocity), history, stored, stiffness);
    auto const roll = rolling_law(pair, at, normal, n, contact.spin, history + Tangential::history);
    contact.tangential = kept(contact.touch, slide.force);
    contact.rolling = kept(contact.touch, roll.torque);
    contact.force = kept(contact.touch, mul_add(normal.force, n, slide.force));
    if constexpr (Ledger) {
        // The speed at the end of the step, where the force is: half a step more of this contact's acceleration.
        Both const speed = at.speed + Both(0.5) * at.step * normal.force * at.inverse_mass;
        stored += roll.energy;
        contact.dissipated =
            (normal.elastic - normal.force) * speed * at.step + slide.work + roll.work + history[columns - 1] - stored;
        contact.elastic = normal.energy + stored;
        history[columns - 2] = stiffness, history[columns - 1] = stored;
    }
    Lanes const zero = 0.0;
    for (std::size_t c = 0; c < columns; ++c) {
        store(select(contact.touch.a, history[c].a, zero), contact.history[0] + c * block);
        store(select(contact.touch.b, history[c].b, zero), contact.history[1] + c * block);
    }
}

// What the laws need about each lane's pairing of materials.
class Pairings
{
  public:
    HWY_INLINE Pairings(Rules const& rules, std::uint8_t const* material, std::size_t common, Pair<Both>& to)
        : rules_(rules), material_(material), to_(to)
    {
        std::size_t all[width];
        for (auto& which : all) which = common;
        mix(all, 0);
        mix(all, 1);
    }
    HWY_INLINE void set(std::size_t seat, std::uint32_t const* low, std::uint32_t const* high)
    {
        if (material_ == nullptr) return;
        std::size_t which[width];
        for (std::size_t lane = 0; lane < width; ++lane)
            which[lane] = material_[row_of(low[lane])] * rules_.materials + material_[row_of(high[lane])];
        mix(which, seat);
    }
    HWY_INLINE void set_with_walls(std::size_t seat, std::uint32_t const* granules, std::uint8_t const* walls)
    {
        std::size_t which[width];
        for (std::size_t lane = 0; lane < width; ++lane)
            which[lane] = (material_ ? material_[row_of(granules[lane])] : 0) * rules_.materials + walls[lane];
        mix(which, seat);
    }

  private:
    HWY_INLINE void mix(std::size_t const* which, std::size_t seat)
    {
        static_assert(sizeof(Pair<double>) == Pair<double>::size * sizeof(double));
        alignas(64) double values[width];
        std::size_t at = 0;
        to_.visit([&](Both& member) {
            for (std::size_t lane = 0; lane < width; ++lane)
                values[lane] = reinterpret_cast<double const*>(rules_.pairs + which[lane])[at];
            member.part(seat) = load(values);
            ++at;
        });
    }
    Rules const& rules_;
    std::uint8_t const* material_;
    Pair<Both>& to_;
};

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

HWY_INLINE Triple<Lanes> nearest_image(Triple<Lanes> const& apart, Images const& images)
{
    auto const along = [&images](Lanes difference, std::size_t d) {
        Lanes const length = images.length[d], half = images.half[d];
        return difference - select(difference > half, length, select(difference < -half, -length, Lanes(0.0)));
    };
    return {along(apart.x, 0), along(apart.y, 1), along(apart.z, 2)};
}

using first = std::integral_constant<std::size_t, 0>;
using second = std::integral_constant<std::size_t, 1>;

// What a pass adds up.
struct Energies
{
    Lanes coarse = 0.0, fine = 0.0;

    // `half` of the energy, so that each of two ranks that know a contact can count it; twice the share of this one.
    HWY_INLINE void add(Mask where, Lanes half, Lanes twice_share, Lanes coarse_by, Lanes fine_by)
    {
        half = select(where, half, Lanes(0.0));
        Lanes const rough = (half + coarse_by) - coarse_by;
        coarse += twice_share * rough;
        fine += twice_share * (((half - rough) + fine_by) - fine_by);
    }
    void tell(Energy& to) const { to.coarse += sum(coarse), to.fine += sum(fine); }
};

struct Tally
{
    Lanes worst, coarse_by, fine_by;
    Energies dissipated, elastic;
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
        dissipated.add(over, Lanes(0.5) * load(stored), share + share, coarse_by, fine_by);
    }
    HWY_INLINE void energies(Staged& contact, std::size_t seat, Lanes share)
    {
        Mask const touch = seat == 0 ? contact.touch.a : contact.touch.b;
        Lanes const half = 0.5, twice = share + share;
        dissipated.add(touch, half * contact.dissipated.part(seat), twice, coarse_by, fine_by);
        elastic.add(touch, half * contact.elastic.part(seat), twice, coarse_by, fine_by);
    }
    void tell(Seen& seen) const
    {
        alignas(64) double each[block];
        store(worst, each);
        for (std::size_t lane = 0; lane < width; ++lane)
            if (each[lane] > seen.largest_overlap) seen.largest_overlap = each[lane];
        seen.contacts += contacts;
        dissipated.tell(seen.dissipated);
        elastic.tell(seen.elastic);
    }
};

// Clears the histories of lanes that touched before and do not any more.
HWY_INLINE void forget(unsigned before, double* history, std::size_t columns)
{
    if ((before & ((1u << width) - 1)) == 0) return;
    for (std::size_t c = 0; c < columns; ++c) store(Lanes(0.0), history + c * block);
}

// Partners are scattered: what a block asks for first is on its way two blocks before.
constexpr std::size_t blocks_ahead = 2;

HWY_INLINE void fetch_positions(Body const* bodies, PairBlock const& pairs)
{
    for (auto const* places : {pairs.low, pairs.high})
        for (std::size_t k = 0; k < block; ++k) __builtin_prefetch(bodies->position + places[k], 1);
}

HWY_FLATTEN void pairs(PairPass const& in, Seen& seen)
{
    Rules const& rules = *in.rules;
    auto const laws = chosen(rules);
    std::size_t const columns = rules.columns;
    Lanes const shift = rules.lever_shift;
    Tally tally(rules, seen);
    Staged contact;
    contact.at.step = in.dt;
    contact.at.inertia = 1.0;
    Pairings pairings(rules, in.material, in.pairing, contact.pair);
    struct
    {
        Recipient low, high;
    } waiting[2];
    std::size_t seat = 0;
    auto const take_up = [&](auto constant) {
        constexpr std::size_t k = decltype(constant)::value;
        auto const& [low, high] = waiting[k];
        auto const force = get(contact.force, k), rolling = get(contact.rolling, k);
        Triple<Lanes> const turn = cross(get(contact.n, k), get(contact.tangential, k));
        Rows const push = rounded(force, low.force_rounder);
        Triple<Lanes> const torque = neg_mul_add(low.lever, turn, rolling), back = mul_add(high.lever, turn, rolling);
        add_pulls<false>(low.sums(in.bodies), push, rounded(torque, low.torque_rounder));
        bool const alike = !any(low.force_rounder != high.force_rounder);
        add_pulls<true>(high.sums(in.bodies), alike ? push : rounded(force, high.force_rounder),
                        rounded(back, high.torque_rounder));
        if (rules.ledger) tally.energies(contact, k, shares(low.places, high.places, place_of(in.owned)));
    };
    for (std::size_t b = 0; b < in.blocks; ++b) {
        if (b + blocks_ahead < in.blocks) fetch_positions(in.bodies, in.pairs[b + blocks_ahead]);
        unsigned const before = in.touching[b];
        unsigned now = 0;
        for (std::size_t s = 0; s < block; s += width) {
            auto const* places_low = in.pairs[b].low + s;
            auto const* places_high = in.pairs[b].high + s;
            double* const history = in.history + b * columns * block + s;
            Partner low(in.bodies, places_low), high(in.bodies, places_high);
            Triple<Lanes> apart = low.position - high.position;
            if (in.images.any) apart = nearest_image(apart, in.images);
            // Rounded as in the plain loops to the last bit: the overlap is what little is left of the distance.
            Lanes const distance2 = apart.x * apart.x + (apart.y * apart.y + apart.z * apart.z);
            Lanes const reach = low.radius + high.radius;
            Mask const touch = distance2 < reach * reach;
            unsigned const bits = touch.bits();
            if (rules.ledger && (before >> s & ~bits & ((1u << width) - 1)) != 0)
                tally.ended(!touch, shares(read_again(places_low), read_again(places_high), place_of(in.owned)),
                            history + (columns - 1) * block);
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
            Triple<Lanes> const turning = mul_add(lever_low, low.spin, lever_high * high.spin);
            Triple<Lanes> const velocity = minus_cross(low.velocity - high.velocity, turning, n);
            // 1/(a b) gives both quotients with one division.
            Lanes const inverse_mass = low.inverse_mass + high.inverse_mass;
            Lanes const inverse_both = reciprocal(reach * inverse_mass);
            pairings.set(seat, read_again(places_low), read_again(places_high));
            auto& at = contact.at;
            at.overlap.part(seat) = overlap;
            at.radius.part(seat) = low.radius * high.radius * (inverse_both * inverse_mass);
            at.mass.part(seat) = inverse_both * reach;
            at.inverse_mass.part(seat) = inverse_mass;
            if (rules.inertia) at.inertia.part(seat) = reciprocal(inverse_inertia(low) + inverse_inertia(high));
            at.speed.part(seat) = dot(velocity, n);
            put(contact.n, seat, n);
            put(contact.velocity, seat, velocity);
            put(contact.spin, seat, low.spin - high.spin);
            (seat == 0 ? contact.touch.a : contact.touch.b) = touch;
            contact.history[seat] = history;
            waiting[seat].low.set(low, lever_low);
            waiting[seat].high.set(high, lever_high);
            if (++seat == 2) {
                laws(rules, contact);
                take_up(first{}), take_up(second{});
                seat = 0;
            }
        }
        if (in.collisions && (now & ~before) != 0 && in.dt > 0) collide(in, b, now & ~before);
        in.touching[b] = static_cast<std::uint8_t>(now);
    }
    if (seat == 1) {
        contact.leave_second_empty();
        laws(rules, contact);
        take_up(first{});
    }
    tally.tell(seen);
}

HWY_FLATTEN void walls(WallPass const& in, Seen& seen)
{
    Rules const& rules = *in.rules;
    auto const laws = chosen(rules);
    std::size_t const columns = rules.columns;
    Lanes const zero = 0.0, shift = rules.lever_shift;
    Tally tally(rules, seen);
    Staged contact;
    contact.at.step = in.dt;
    contact.at.inertia = 1.0;
    Pairings pairings(rules, in.material, 0, contact.pair);
    auto const triple = [](double const* const* from, std::size_t place) {
        return Triple<Lanes>{load(from[0] + place), load(from[1] + place), load(from[2] + place)};
    };
    auto const keep = [](Triple<Lanes> const& what, double* const* to, std::size_t place) {
        store(what.x, to[0] + place), store(what.y, to[1] + place), store(what.z, to[2] + place);
    };
    struct
    {
        Recipient granule;
        std::size_t place;
    } waiting[2];
    std::size_t seat = 0;
    auto const take_up = [&](auto constant) {
        constexpr std::size_t k = decltype(constant)::value;
        auto const& [granule, place] = waiting[k];
        auto const force = get(contact.force, k);
        Triple<Lanes> const turn = cross(get(contact.n, k), get(contact.tangential, k));
        Triple<Lanes> const torque = neg_mul_add(granule.lever, turn, get(contact.rolling, k));
        add_pulls<false>(granule.sums(in.bodies), rounded(force, granule.force_rounder),
                         rounded(torque, granule.torque_rounder));
        keep(force, in.force, place);
        keep(torque, in.torque, place);
        if (rules.ledger) tally.energies(contact, k, Lanes(1.0));
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
            Partner granule(in.bodies, in.granule + place);
            granule.look();
            Triple<Lanes> const n = triple(in.normal, place);
            overlap = select(touch, overlap, Lanes(1e-3) * granule.radius);
            tally.overlap(touch, overlap, granule.radius);
            Lanes const lever = granule.radius - shift * overlap;
            Triple<Lanes> const velocity =
                minus_cross(granule.velocity - triple(in.velocity, place), lever * granule.spin, n);
            pairings.set_with_walls(seat, in.granule + place, in.wall_material + place);
            auto& at = contact.at;
            at.overlap.part(seat) = overlap;
            at.radius.part(seat) = granule.radius;
            at.mass.part(seat) = reciprocal(granule.inverse_mass);
            at.inverse_mass.part(seat) = granule.inverse_mass;
            if (rules.inertia) at.inertia.part(seat) = reciprocal(inverse_inertia(granule));
            at.speed.part(seat) = dot(velocity, n);
            put(contact.n, seat, n);
            put(contact.velocity, seat, velocity);
            put(contact.spin, seat, granule.spin - triple(in.spin, place));
            (seat == 0 ? contact.touch.a : contact.touch.b) = touch;
            contact.history[seat] = history;
            waiting[seat].granule.set(granule, lever);
            waiting[seat].place = place;
            if (++seat == 2) {
                laws(rules, contact);
                take_up(first{}), take_up(second{});
                seat = 0;
            }
        }
        if (in.collisions && (now & ~before) != 0 && in.dt > 0) collide(in, b, now & ~before);
        in.touching[b] = static_cast<std::uint8_t>(now);
    }
    if (seat == 1) {
        contact.leave_second_empty();
        laws(rules, contact);
        take_up(first{});
    }
    tally.tell(seen);
}

void look(Look& in, Span const* spans, std::size_t count)
{
    Lanes const x = in.at[0], y = in.at[1], z = in.at[2], own = in.own_radius, skin = in.skin, close = in.close;
    std::size_t near = 0, far = 0;
    for (std::size_t s = 0; s < count; ++s)
        for (std::size_t k = spans[s].begin; k < spans[s].end; k += width) {
            Triple<Lanes> apart{x - load_anywhere(in.x + k), y - load_anywhere(in.y + k), z - load_anywhere(in.z + k)};
            if (in.images.any) apart = nearest_image(apart, in.images);
            Lanes const distance2 = apart.x * apart.x + (apart.y * apart.y + apart.z * apart.z),
                        reach = own + load_anywhere(in.radius + k);
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
}
}
