// Rows P1 to P9 and D09: impacts after Chung and Ooi (Granular Matter 13 (2011) 643) and single spheres that slide and
// roll, each stated as a case and moved by the step of `granum run`. The set-ups are theirs; the expected numbers are
// closed forms (elastic and gross-sliding rows) or an independent integration of one contact.
#include "impact.hpp"
#include "scene/reference.hpp"
#include "table.hpp"

namespace
{
using namespace granum;
using namespace verify;

constexpr Stuff cast_iron{1e11, 0.25, 7000};

TEST(ElasticImpact, of_two_spheres_follows_hertz)
{
    struct Expected
    {
        std::string name;
        Stuff stuff;
        double overlap, force, duration;
    };
    for (auto const& row : {Expected{"glass", scene::glass, 274.113e-6, 10.6969e3, 40.339e-6},
                            Expected{"limestone", scene::limestone, 368.304e-6, 7.10824e3, 54.201e-6}}) {
        double const radius = 0.01, edge = 0.2, apart = radius * (1 + 1e-9);
        auto const simulation = simulate(
            {.stuff = row.stuff,
             .pair = {.restitution = 1, .sliding_friction = 0.35, .rolling_friction = 0},
             .granules = {{.position = {edge / 2 - apart, edge / 2, edge / 2}, .velocity = {10, 0, 0}, .spin = {}},
                          {.position = {edge / 2 + apart, edge / 2, edge / 2}, .velocity = {-10, 0, 0}, .spin = {}}},
             .radius = radius,
             .step = row.duration / 4801.3,  // counted in whole steps: none that divides it
             .size = {edge, edge, edge},
             .gravity = {}});
        auto const seen = collide(*simulation);
        relative("P1", row.name + " on " + row.name + ": largest force, N", row.force, seen.force, 1e-3);
        relative("P1", row.name + " on " + row.name + ": largest overlap, m", row.overlap, seen.overlap, 1e-3);
        relative("P1", row.name + " on " + row.name + ": duration, s", row.duration, seen.duration, 1e-3);
        EXPECT_NEAR(seen.velocity.x, -10, 1e-3);
    }
}

TEST(ElasticImpact, on_the_plate_follows_hertz)
{
    struct Expected
    {
        std::string name;
        Stuff stuff;
        double overlap, force, duration;
    };
    for (auto const& row : {Expected{"aluminium alloy", scene::aluminium_alloy, 49.7172e-6, 11.3699e3, 731.656e-6},
                            Expected{"magnesium alloy", scene::magnesium_alloy, 52.1233e-6, 7.23268e3, 767.066e-6}}) {
        auto const seen = on_plate(row.stuff, 0.1, {0, 0, -0.2}, {.restitution = 1, .sliding_friction = 0});
        relative("P2", row.name + " on a rigid plane: largest force, N", row.force, seen.force, 1e-3);
        relative("P2", row.name + " on a rigid plane: largest overlap, m", row.overlap, seen.overlap, 1e-3);
        relative("P2", row.name + " on a rigid plane: duration, s", row.duration, seen.duration, 1e-3);
    }
}

TEST(Restitution, comes_out_as_it_went_in)
{
    for (auto const& [name, stuff] : {std::pair{"aluminium oxide", scene::aluminium_oxide}, {"cast iron", cast_iron}})
        for (double const e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
            auto const seen = on_plate(stuff, 2.5e-3, {0, 0, -3.9}, {.restitution = e, .sliding_friction = 0});
            relative("P3", fmt::format("{}: restitution asked for {}", name, e), e, seen.velocity.z / 3.9, 5e-3);
        }
}

//! Tangential restitution at 3.9 m/s, `degrees` from the normal.
double tangential_restitution(Stuff const& stuff, double degrees, std::string const& law = "mindlin")
{
    double const along = 3.9 * std::sin(radians(degrees));
    auto scenario = above_plate(stuff, 2.5e-3, {along, 0, -3.9 * std::cos(radians(degrees))},
                                {.restitution = 0.98, .sliding_friction = 0.092});
    scenario.contact += "\ntangential = \"" + law + "\"";
    return collide(*simulate(scenario)).velocity.x / along;
}

TEST(ObliqueImpact, that_slides_throughout_keeps_the_share_of_a_rigid_body)
{
    for (auto const& [degrees, expected] : {std::pair{40.0, 0.7829}, {60.0, 0.8948}}) {
        absolute("P4", fmt::format("aluminium oxide at {} deg: tangential restitution", degrees), expected,
                 tangential_restitution(scene::aluminium_oxide, degrees), 1e-3);
        absolute("P4", fmt::format("aluminium alloy at {} deg: tangential restitution", degrees), expected,
                 tangential_restitution(scene::aluminium_alloy_oblique, degrees), 1e-3);
    }
}

TEST(ObliqueImpact, that_sticks_for_a_while_follows_the_integrated_contact)
{
    struct Expected
    {
        double degrees, total, incremental;
    };
    for (auto const& row : {Expected{5, 0.9645, 0.8888}, Expected{10, 0.6984, 0.7089}, Expected{20, 0.6225, 0.6120}}) {
        auto const name = fmt::format("aluminium oxide at {} deg: tangential restitution", row.degrees);
        absolute("P5", name + ", mindlin", row.total, tangential_restitution(scene::aluminium_oxide, row.degrees),
                 5e-3);
        absolute("P5", name + ", mindlin-incremental", row.incremental,
                 tangential_restitution(scene::aluminium_oxide, row.degrees, "mindlin-incremental"), 5e-3);
    }
}

TEST(ObliqueImpact, at_constant_normal_speed_gives_the_rebound_curve_for_both_levers)
{
    struct Expected
    {
        double tangential, lever_radius, lever_contact;  //!< m/s, 1, 1
    };
    double const radius = 1e-5, mu = 0.3, normal = 5;
    for (auto const& row : {Expected{12, 1.0, 1.0132}, Expected{5.25, -1.2414, -1.2576}})
        for (bool const lever_radius : {true, false}) {
            auto const seen = on_plate(scene::steel, radius, {row.tangential, 0, -normal},
                                       {.restitution = 1, .sliding_friction = mu}, {}, lever_radius);
            double const slip = seen.velocity.x - radius * seen.spin.y;
            absolute("P6",
                     fmt::format("steel, normalised angle {}, lever {}: rebound", row.tangential / (mu * normal),
                                 lever_radius ? "R" : "R - overlap/2"),
                     lever_radius ? row.lever_radius : row.lever_contact, slip / (mu * seen.velocity.z), 5e-3);
        }
}

TEST(SpinningSphere, leaves_the_plate_with_the_speed_of_gross_sliding)
{
    struct Expected
    {
        double spin, speed, after, speed_tolerance, spin_tolerance;
    };
    // 4 rad/s switches between stick and slip near the end of the contact and does not converge with the step.
    for (auto const& row :
         {Expected{21, -0.12, 18, 1e-3 * 0.12, 1e-3 * 18}, Expected{4, -0.11884, 1.0291, 5e-4, 1e-2}}) {
        // Spin about -y: the contact point moves along +x and friction pushes the sphere back.
        auto const seen = on_plate(scene::aluminium_alloy_oblique, 0.1, {0, 0, -0.2},
                                   {.restitution = 0.5, .sliding_friction = 0.4}, {0, -row.spin, 0});
        auto const name = fmt::format("aluminium alloy spinning at {} rad/s: ", row.spin);
        absolute("P7", name + "speed after, m/s", row.speed, seen.velocity.x, row.speed_tolerance);
        absolute("P7", name + "spin after, rad/s", row.after, -seen.spin.y, row.spin_tolerance);
        EXPECT_NEAR(seen.velocity.x, -0.04 * (row.spin + seen.spin.y), 1e-9) << "angular momentum about the contact";
    }
}

TEST(SlidingSphere, rolls_after_two_sevenths_of_the_speed_over_the_friction)
{
    double const radius = 5e-4, speed = 0.1;
    for (double const friction : {0.2, 0.6, 1.0}) {
        auto const simulation = along_the_plate({1e8, 0.25, 1e4}, radius, speed, 0,
                                                {.restitution = 0.5, .sliding_friction = friction}, 0.02, 5e-7);
        auto const& granules = simulation->granules();
        auto const slip = [&] { return granules.velocity[0].x - radius * granules.spin[0].y; };
        while (slip() > 1e-4 * speed && simulation->time() < 0.1) simulation->step(simulation->granule_dt());
        relative("P8", fmt::format("friction {}: sliding turns into rolling, s", friction),
                 2 * speed / (7 * friction * 9.81), simulation->time(), 0.01);
        relative("P8", fmt::format("friction {}: speed then, m/s", friction), 5 * speed / 7, granules.velocity[0].x,
                 0.01);
    }
}

TEST(RollingSphere, stops_when_and_where_the_reference_says)
{
    scene::Table const table("dem-09.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const radius = 0.01, speed = table.number(row, "v0_m_per_s"), mu = table.number(row, "mu_r");
        auto const simulation =
            along_the_plate({1e7, 0.25, 1445}, radius, speed, speed / radius,
                            {.restitution = 0.3, .sliding_friction = 0.8, .rolling_friction = mu}, 1, 1e-5);
        auto const& granules = simulation->granules();
        double const start = granules.position[0].x;
        while (granules.velocity[0].x > 0 && simulation->time() < 3) simulation->step(simulation->granule_dt());
        auto const name = fmt::format("rolling friction {}, {} m/s: ", mu, speed);
        relative("D09", name + "time to the stop, s", table.number(row, "t_stop_s"), simulation->time(), 0.01);
        relative("D09", name + "distance to the stop, m", table.number(row, "distance_m"),
                 granules.position[0].x - start, 0.01);
    }
}

TEST(RollingSphere, stops_after_the_distance_that_the_rolling_friction_sets)
{
    double const radius = 0.01, speed = 1;
    auto const simulation =
        along_the_plate({1e7, 0.25, 1445}, radius, speed, speed / radius,
                        {.restitution = 0.3, .sliding_friction = 0.8, .rolling_friction = 0.1}, 1, 1e-5);
    auto const& granules = simulation->granules();
    double const start = granules.position[0].x;
    while (simulation->time() < 1.5) simulation->step(simulation->granule_dt());  // it stops after 1.4271 s
    relative("P9", "rolling friction 0.1, 1 m/s: distance to the stop, m", 0.71356, granules.position[0].x - start,
             0.05);
    EXPECT_NEAR(granules.velocity[0].x, 0, 0.02);
}
}
