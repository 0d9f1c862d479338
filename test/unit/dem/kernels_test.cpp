// Every instruction set against the plain loops, over random contacts: forces and torques to 1e-12 of the force at an
// overlap of a thousandth of the radius, energies and histories likewise; the motion
// of rows to the bit.
#include "granum/dem/frame.hpp"
#include "granum/dem/kernel/kernel.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>

namespace
{
using namespace granum;
using namespace granum::dem;
using kernel::block;

double between(double low, double high)
{
    return low + (high - low) * (*rc::gen::inRange(0, 1'000'001)) * 1e-6;
}

Vec3 direction()
{
    Vec3 const v{between(-1, 1), between(-1, 1), between(-1, 1)};
    return v / std::max(norm(v), 1e-3);
}

// Pairs that touch, nearly touch or do not, a few of them sharing granules; one to three materials.
struct Contacts
{
    Laws laws;
    Frame frame;
    std::vector<law::contact::Pair<double>> pairings;
    std::vector<double> restitutions;
    kernel::Rules rules;
    base::AlignedVector<kernel::PairBlock> pairs;
    base::AlignedVector<double> history;
    std::vector<std::uint8_t> touching;
    double smallest = 0, unit = 0;  // radius, m, and its force at an overlap of a thousandth, N

    Contacts()
    {
        using namespace law::contact;
        laws.normal = *NormalLaws::make(*rc::gen::elementOf(NormalLaws::names()));
        laws.tangential = *TangentialLaws::make(*rc::gen::elementOf(TangentialLaws::names()));
        laws.rolling = *RollingLaws::make(*rc::gen::elementOf(RollingLaws::names()));
        auto const materials = static_cast<std::uint32_t>(*rc::gen::inRange(1, 4));
        for (std::uint32_t m = 0; m < materials; ++m)
            laws.add({.youngs_modulus = std::pow(10, between(6, 9)), .poisson_ratio = between(0.1, 0.45)});
        for (std::uint32_t a = 0; a < materials; ++a)
            for (std::uint32_t b = a; b < materials; ++b)
                laws.pair(a, b,
                          {.restitution = between(0.2, 1),
                           .sliding_friction = between(0, 1),
                           .rolling_friction = between(0, 0.3),
                           .rolling_damping = between(0, 0.5)});
        for (std::uint32_t a = 0; a < materials; ++a)
            for (std::uint32_t b = 0; b < materials; ++b) {
                pairings.push_back(laws.effective(a, b));
                restitutions.push_back(laws.pair(a, b).restitution);
            }
        auto const columns = [](auto const& law) {
            return std::visit([](auto const& one) { return static_cast<std::size_t>(one.history); }, law);
        };
        auto const address = [](auto const& law) {
            return std::visit([](auto const& one) -> void const* { return &one; }, law);
        };
        bool const ledger = *rc::gen::arbitrary<bool>();
        rules = {.normal_index = laws.normal.index(),
                 .tangential_index = laws.tangential.index(),
                 .rolling_index = laws.rolling.index(),
                 .normal = address(laws.normal),
                 .tangential = address(laws.tangential),
                 .rolling = address(laws.rolling),
                 .pairs = pairings.data(),
                 .materials = materials,
                 .lever_shift = *rc::gen::element(0.0, 0.5),
                 .inertia = true,
                 .ledger = ledger,
                 .columns = columns(laws.tangential) + columns(laws.rolling) + (ledger ? 2 : 0),
                 .restitution = restitutions.data(),
                 .wear_threshold = between(0, 0.1)};
        place(static_cast<std::size_t>(*rc::gen::inRange(1, 40)), materials);
    }

    void place(std::size_t count, std::uint32_t materials)
    {
        particle::Store granules;
        granules.keep({false, false, false});
        granules.resize(2 * count);
        granules.owned = 2 * count;
        double const radius = std::pow(10, between(-4, -2)), speed = between(0, 2);
        std::size_t const blocks = (count + block - 1) / block;
        pairs.resize(blocks);
        for (std::size_t k = 0; k < 2 * count; ++k) {
            granules.id[k] = k;
            granules.radius[k] = radius * between(1, 4);
            granules.mass[k] = 2000 * std::pow(granules.radius[k], 3);
            granules.velocity[k] = speed * direction();
            granules.spin[k] = speed / radius * direction();
            granules.material[k] = static_cast<std::uint32_t>(*rc::gen::inRange(0u, materials));
        }
        for (std::size_t k = 0; k < count; ++k) {
            double const overlap = std::pow(10, between(-8, -1)) * *rc::gen::element(1.0, 1.0, 1.0, -1.0);
            double const reach = granules.radius[2 * k] + granules.radius[2 * k + 1];
            granules.position[2 * k] = {20.0 * static_cast<double>(k) * radius, between(0, 1), 0};
            granules.position[2 * k + 1] = granules.position[2 * k] + reach * (1 - 0.25 * overlap) * direction();
        }
        frame.scale_to(laws);
        frame.take(granules);
        smallest = radius;
        unit = frame.unit_force * (frame.unit_power == 2 ? radius * radius : radius);
        history.assign(blocks * rules.columns * block, 0.0);
        touching.assign(blocks, 0);
        for (std::size_t k = 0; k < blocks * block; ++k) {
            bool const real = k < count;
            pairs[k / block].low[k % block] = kernel::place_of(real ? 2 * k : frame.lonely());
            pairs[k / block].high[k % block] = kernel::place_of(real ? 2 * k + 1 : frame.lonely() + 1);
        }
    }

    kernel::PairPass pass(double dt)
    {
        return {.rules = &rules,
                .bodies = frame.bodies.data(),
                .material = rules.materials > 1 ? frame.material.data() : nullptr,
                .pairing = 0,
                .blocks = pairs.size(),
                .pairs = pairs.data(),
                .images = {},
                .history = history.data(),
                .touching = touching.data(),
                .owned = frame.owned - 1,
                .dt = dt,
                .collisions = nullptr};
    }
};

RC_GTEST_PROP(Kernels, agree_with_the_plain_loops_over_random_contacts, ())
{
    Contacts contacts;
    double const dt = std::pow(10, between(-7, -5));
    int const steps = *rc::gen::inRange(1, 6);
    for (auto const* fast : kernel::kernels()) {
        // Copies of the numbers; the laws stay where they are.
        auto bodies = contacts.frame.bodies;
        auto history = contacts.history;
        auto touching = contacts.touching;
        auto plain_bodies = bodies;
        auto plain_history = history;
        auto plain_touching = touching;
        std::vector<kernel::Collisions> collisions(bodies.size()), plain_collisions = collisions;
        for (int step = 0; step < steps; ++step) {
            // Histories follow the plain loops, so that each step is compared by itself.
            history = plain_history;
            touching = plain_touching;
            plain_bodies = bodies;
            auto pass = contacts.pass(dt);
            kernel::Seen seen, plain;
            pass.bodies = bodies.data(), pass.history = history.data(), pass.touching = touching.data();
            pass.collisions = collisions.data();
            fast->pairs(pass, seen);
            pass.bodies = plain_bodies.data(), pass.history = plain_history.data(),
            pass.touching = plain_touching.data(), pass.collisions = plain_collisions.data();
            kernel::scalar().pairs(pass, plain);
            RC_ASSERT(touching == plain_touching);
            RC_ASSERT(seen.contacts == plain.contacts);
            RC_ASSERT(std::abs(seen.largest_overlap - plain.largest_overlap) <= 1e-14);
            for (std::size_t row = 0; row < contacts.frame.owned; ++row) {
                auto const &met = collisions[row].granules, &plainly = plain_collisions[row].granules;
                RC_ASSERT(met.count == plainly.count);
                RC_ASSERT(std::abs(met.speed - plainly.speed) <= 1e-11);
                RC_ASSERT(std::abs(met.wear - plainly.wear) <= 1e-11);
                auto const force = [](kernel::Body const& body) { return Frame::vec(body.force); };
                auto const torque = [](kernel::Body const& body) { return Frame::vec(body.torque); };
                // The force at an overlap of a thousandth of this radius, or what the spring has at the true overlap
                // where that is larger (the dashpot may take most of it away), and what is rounded the other way.
                double const radius = bodies[row].radius, ratio = radius / contacts.smallest;
                double const reference = contacts.unit * (contacts.frame.unit_power == 2 ? ratio * ratio : ratio);
                double const apart = norm(Frame::vec(bodies[row].position) - Frame::vec(bodies[row ^ 1].position));
                double const deep = std::max(0.0, 1e3 * (radius + bodies[row ^ 1].radius - apart) / radius);
                double const spring = reference * (contacts.frame.unit_power == 2 ? std::pow(deep, 1.5) : deep);
                double const grain = 1e-12 * std::max({reference, spring, norm(force(plain_bodies[row]))}) +
                                     2 * bodies[row].rounder * 0x1p-52;
                RC_ASSERT(norm(force(bodies[row]) - force(plain_bodies[row])) <= grain);
                RC_ASSERT(norm(torque(bodies[row]) - torque(plain_bodies[row])) <= radius * grain);
            }
            double const energy =
                contacts.unit * bodies[0].radius + std::abs(plain.elastic.value()) + std::abs(plain.dissipated.value());
            RC_ASSERT(std::abs(seen.elastic.value() - plain.elastic.value()) <= 1e-11 * energy);
            RC_ASSERT(std::abs(seen.dissipated.value() - plain.dissipated.value()) <= 1e-11 * energy);
            for (std::size_t b = 0; b < bodies.size() - 2; ++b) {
                for (std::size_t d = 0; d < 3; ++d) bodies[b].position[d] += dt * bodies[b].velocity[d];
                std::fill_n(bodies[b].force, 8, 0.0);
            }
        }
    }
}

TEST(Kernels, are_named_fastest_first_and_end_with_the_plain_loops)
{
    auto const here = kernel::kernels();
    ASSERT_GE(here.size(), 1u);
    EXPECT_EQ(here.back()->name, "scalar");
    for (auto const* kernel : here) EXPECT_EQ(kernel::find_kernel(kernel->name), kernel);
    EXPECT_EQ(kernel::find_kernel("altivec"), nullptr);
}

// Rows of a motion and what the gas does to them, at random; a third of them in still gas of no rate.
struct Rows
{
    base::AlignedVector<kernel::Body> bodies;
    base::AlignedVector<kernel::Drag> gas, turn;
    std::vector<std::uint32_t> rows;
    std::vector<bool> still;
    double half = 0;
    Vec3 gravity;

    Rows()
    {
        auto const count = static_cast<std::uint32_t>(*rc::gen::inRange(1, 40));
        half = std::pow(10, between(-7, -4));
        gravity = 10 * direction();
        for (std::uint32_t row = 0; row < count; ++row) {
            Vec3 const x = between(0, 1) * direction(), v = between(0, 3) * direction(),
                       w = between(0, 99) * direction(), f = between(0, 1e-3) * direction(),
                       t = between(0, 1e-6) * direction();
            double const mass = std::pow(10, between(-8, -3)), radius = between(1e-4, 1e-2);
            bodies.push_back({.position = {x.x, x.y, x.z},
                              .radius = radius,
                              .velocity = {v.x, v.y, v.z},
                              .inverse_mass = 1 / mass,
                              .spin = {w.x, w.y, w.z},
                              .rounder = 1,
                              .built = {},
                              .per_room2 = between(1, 100),
                              .force = {f.x, f.y, f.z, 0},
                              .torque = {t.x, t.y, t.z, 0}});
            bool const calm = *rc::gen::inRange(0, 3) == 0;
            still.push_back(calm);
            gas.push_back(pulled(calm ? 0 : between(0, 1), calm ? half * gravity : between(0, 3) * direction(),
                                 half * (1 / mass)));
            turn.push_back(pulled(calm ? 0 : between(0, 1), calm ? Vec3{} : between(0, 99) * direction(),
                                  half * 2.5 * (1 / mass) / (radius * radius)));
            rows.push_back(count - 1 - row);
        }
    }

    static kernel::Drag pulled(double share, Vec3 const& pull, double push)
    {
        return {.pull = {pull.x, pull.y, pull.z}, .share = share, .given = {}, .push = push};
    }

    kernel::MotionSeen move(kernel::Kernel const& kernel, int kicks, bool drifts, bool in_gas, bool turns)
    {
        kernel::MotionSeen seen;
        kernel.move({.bodies = bodies.data(),
                     .rows = rows.data(),
                     .count = rows.size(),
                     .gravity = {gravity.x, gravity.y, gravity.z},
                     .half = half,
                     .drift = drifts ? 2 * half : 0,
                     .kicks = kicks,
                     .clear = drifts,
                     .gas = in_gas ? gas.data() : nullptr,
                     .turn = turns ? turn.data() : nullptr},
                    seen);
        return seen;
    }
};

template <class T>
bool same(T const& a, T const& b)
{
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

RC_GTEST_PROP(Kernels, move_rows_to_the_same_bits_with_gas_and_without, ())
{
    Rows const given;
    for (auto const& [kicks, drifts] : {std::pair{1, false}, std::pair{1, true}, std::pair{2, true}})
        for (int const gas : {0, 1, 2}) {
            Rows plain = given;
            auto const expected = plain.move(kernel::scalar(), kicks, drifts, gas > 0, gas > 1);
            for (auto const* kernel : kernel::kernels()) {
                Rows fast = given;
                auto const seen = fast.move(*kernel, kicks, drifts, gas > 0, gas > 1);
                for (std::size_t row = 0; row < given.bodies.size(); ++row) {
                    RC_ASSERT(same(fast.bodies[row], plain.bodies[row]));
                    RC_ASSERT(same(fast.gas[row], plain.gas[row]) && same(fast.turn[row], plain.turn[row]));
                }
                RC_ASSERT(seen.finite);
                if (drifts) RC_ASSERT(seen.hastiest2 >= expected.hastiest2 * (1 - 1e-12));
            }
        }
}

RC_GTEST_PROP(Kernels, leave_rows_in_still_gas_of_no_rate_the_bits_of_no_gas, ())
{
    Rows const given;
    int const kicks = *rc::gen::inRange(1, 3);
    for (auto const* kernel : kernel::kernels()) {
        Rows alone = given, in_gas = given;
        alone.move(*kernel, kicks, true, false, false);
        in_gas.move(*kernel, kicks, true, true, true);
        for (std::size_t row = 0; row < given.bodies.size(); ++row) {
            auto const &a = alone.bodies[row], &b = in_gas.bodies[row];
            for (std::size_t d = 0; d < 3 && given.still[row]; ++d)
                RC_ASSERT(a.position[d] == b.position[d] && a.velocity[d] == b.velocity[d] && a.spin[d] == b.spin[d]);
        }
    }
}

RC_GTEST_PROP(Kernels, see_a_number_that_is_not_finite, ())
{
    Rows const given;
    auto const bad = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(given.bodies.size())));
    auto const d = static_cast<std::size_t>(*rc::gen::inRange(0, 3));
    bool const turns = *rc::gen::arbitrary<bool>();
    for (auto const* kernel : kernel::kernels()) {
        Rows rows = given;
        (turns ? rows.bodies[bad].spin : rows.bodies[bad].velocity)[d] = std::nan("");
        RC_ASSERT(!rows.move(*kernel, 2, true, true, true).finite);
        rows = given;
        (turns ? rows.bodies[bad].spin : rows.bodies[bad].velocity)[d] = std::nan("");
        RC_ASSERT(!rows.move(*kernel, 1, true, false, false).finite);
    }
}
}
