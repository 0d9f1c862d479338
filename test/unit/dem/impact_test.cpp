// The impacts of Chung and Ooi (Granular Matter 13 (2011) 643) through the engine. The set-ups are theirs; the expected
// numbers are from closed forms (elastic and gross-sliding rows) or from an independent integration of one contact.
#include "scene/granules.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum;
using math::Vec3;
using scene::Stuff;

double wall_modulus(Stuff const& stuff)
{
    return stuff.youngs_modulus / (1 - stuff.poisson_ratio * stuff.poisson_ratio);
}
double sphere_mass(Stuff const& stuff, double radius)
{
    return 4.0 / 3.0 * math::pi * radius * radius * radius * stuff.density;
}

// Contact time of an impact on the rigid plane with `speed` along the normal.
double plane_time(Stuff const& stuff, double radius, double speed)
{
    return scene::hertz_time(wall_modulus(stuff), radius, sphere_mass(stuff, radius), speed);
}

struct After
{
    Vec3 velocity, spin;
    scene::Impact impact;
};

After impact_on_plane(Stuff const& stuff, double radius, Vec3 const& velocity, dem::PairProperties const& properties,
                      Vec3 const& spin = {}, dem::Lever lever = dem::Lever::radius, double steps_per_contact = 4000)
{
    auto scene = scene::sphere_on_plane(stuff, radius, velocity, properties, spin);
    scene.settings.laws.lever = lever;
    scene.settings.laws.rolling = law::contact::NoRolling{};
    scene.prepare();
    auto const seen = scene::run_impact(scene, plane_time(stuff, radius, -velocity.z) / steps_per_contact);
    return {scene.granules.velocity[0], scene.granules.spin[0], seen};
}

TEST(ElasticImpact, of_two_spheres_has_the_hertz_force_overlap_and_duration)
{
    struct Row
    {
        Stuff stuff;
        double overlap, force, duration;
    };
    for (auto const& row : {Row{scene::glass, 274.113e-6, 10.6969e3, 40.339e-6},
                            Row{scene::limestone, 368.304e-6, 7.10824e3, 54.201e-6}}) {
        auto scene = scene::two_spheres(row.stuff, 0.01, 10, {.restitution = 1, .sliding_friction = 0.35});
        scene.prepare();
        auto const seen = scene::run_impact(scene, row.duration / 5000);
        EXPECT_NEAR(seen.largest_force / row.force, 1, 1e-3);
        EXPECT_NEAR(seen.largest_overlap / row.overlap, 1, 1e-3);
        EXPECT_NEAR(seen.duration / row.duration, 1, 1e-3);
        EXPECT_NEAR(scene.granules.velocity[0].x, -10, 1e-4);
    }
}

TEST(ElasticImpact, on_a_rigid_plane_has_the_hertz_force_overlap_and_duration)
{
    struct Row
    {
        Stuff stuff;
        double overlap, force, duration;
    };
    for (auto const& row : {Row{scene::aluminium_alloy, 49.7172e-6, 11.3699e3, 731.656e-6},
                            Row{scene::magnesium_alloy, 52.1233e-6, 7.23268e3, 767.066e-6}}) {
        auto const after = impact_on_plane(row.stuff, 0.1, {0, 0, -0.2}, {.restitution = 1, .sliding_friction = 0});
        EXPECT_NEAR(after.impact.largest_force / row.force, 1, 1e-3);
        EXPECT_NEAR(after.impact.largest_overlap / row.overlap, 1, 1e-3);
        EXPECT_NEAR(after.impact.duration / row.duration, 1, 1e-3);
    }
}

TEST(Restitution, measured_is_the_requested_one)
{
    for (Stuff const& stuff : {scene::aluminium_oxide, Stuff{1e11, 0.25, 7000}})
        for (double const e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
            auto const after = impact_on_plane(stuff, 2.5e-3, {0, 0, -3.9}, {.restitution = e, .sliding_friction = 0});
            EXPECT_NEAR(after.velocity.z / 3.9, e, 5e-3 * e) << "asked for " << e;
        }
}

TEST(Restitution, of_sphere_pairs_does_not_depend_on_speed_with_the_pull_cut_or_kept)
{
    for (auto const attraction : {law::contact::Attraction::cut, law::contact::Attraction::keep})
        for (double const e : {0.3, 0.75, 0.9})
            for (double const speed : {0.01, 1.0}) {
                auto scene = scene::two_spheres({1e7, 0.25, 1445}, 0.3e-3, speed, {.restitution = e});
                scene.settings.laws.normal = law::contact::HertzTsuji{attraction};
                scene.prepare();
                double const mass = 0.5 * sphere_mass({1e7, 0.25, 1445}, 0.3e-3);
                scene::run_impact(scene, scene::hertz_time(0.5e7 / (1 - 0.0625), 0.15e-3, mass, 2 * speed) / 4000);
                EXPECT_NEAR(scene.granules.velocity[1].x / speed, e, 5e-3 * e) << speed << " m/s";
            }
}

// Test 4: oblique impact at 3.9 m/s.
After oblique(Stuff const& stuff, double degrees)
{
    double const angle = degrees * math::pi / 180;
    return impact_on_plane(stuff, 2.5e-3, {3.9 * std::sin(angle), 0, -3.9 * std::cos(angle)},
                           {.restitution = 0.98, .sliding_friction = 0.092});
}

TEST(ObliqueImpact, that_slides_throughout_keeps_the_rigid_body_tangential_speed_and_spin)
{
    for (Stuff const& stuff : {scene::aluminium_oxide, scene::aluminium_alloy_oblique})
        for (double const degrees : {40.0, 60.0}) {
            double const angle = degrees * math::pi / 180, slip = 0.092 * 1.98;
            auto const after = oblique(stuff, degrees);
            EXPECT_NEAR(after.velocity.x / (3.9 * std::sin(angle)), 1 - slip / std::tan(angle), 1e-3);
            EXPECT_NEAR(after.spin.y, 2.5 * slip * 3.9 * std::cos(angle) / 2.5e-3, 1);
        }
    EXPECT_NEAR(oblique(scene::aluminium_oxide, 40).velocity.x / (3.9 * std::sin(40 * math::pi / 180)), 0.7829, 1e-3);
    EXPECT_NEAR(oblique(scene::aluminium_oxide, 60).velocity.x / (3.9 * std::sin(60 * math::pi / 180)), 0.8948, 1e-3);
}

TEST(ObliqueImpact, that_sticks_for_a_while_follows_the_integrated_contact)
{
    struct Row
    {
        double degrees, oxide, oxide_spin, alloy, alloy_spin;
    };
    for (auto const& row : {Row{5, 0.9645, 12.1, 0.9170, 28.2}, Row{10, 0.6984, 204.3, 0.6737, 221.0},
                            Row{15, 0.6330, 370.5, 0.6188, 384.8}, Row{20, 0.6225, 503.6, 0.6143, 514.5},
                            Row{25, 0.6393, 594.5, 0.6355, 600.7}, Row{30, 0.6847, 614.8, 0.6847, 614.8}}) {
        double const tangential = 3.9 * std::sin(row.degrees * math::pi / 180);
        auto const oxide = oblique(scene::aluminium_oxide, row.degrees);
        auto const alloy = oblique(scene::aluminium_alloy_oblique, row.degrees);
        EXPECT_NEAR(oxide.velocity.x / tangential, row.oxide, 5e-3) << row.degrees;
        EXPECT_NEAR(oxide.spin.y, row.oxide_spin, 2) << row.degrees;
        EXPECT_NEAR(alloy.velocity.x / tangential, row.alloy, 5e-3) << row.degrees;
        EXPECT_NEAR(alloy.spin.y, row.alloy_spin, 2) << row.degrees;
    }
}

// Test 5: normal speed 5 m/s, tangential speed v_t; slip of the contact point after, over mu v_n'.
std::array<double, 2> rebound(Stuff const& stuff, double tangential, dem::Lever lever)
{
    double const radius = 1e-5;
    auto const after =
        impact_on_plane(stuff, radius, {tangential, 0, -5}, {.restitution = 1, .sliding_friction = 0.3}, {}, lever);
    return {(after.velocity.x - radius * after.spin.y) / (0.3 * after.velocity.z), -radius * after.spin.y / (0.3 * 5)};
}

TEST(ObliqueImpact, at_constant_normal_speed_gives_the_rebound_curve)
{
    struct Row
    {
        double tangential, steel, steel_spin, plastic, plastic_spin;
    };
    for (auto const& row : {Row{0.6, 0.3811, -0.0135, 0.3118, -0.0630}, Row{1.2, 0.7210, -0.0564, 0.5173, -0.2019},
                            Row{2.7, -0.0934, -1.3524, -0.2839, -1.4885}, Row{5.25, -1.2414, -3.3867, -1.3944, -3.4960},
                            Row{7.5, -1.4356, -4.5969, -1.5185, -4.6561}, Row{9, -0.9814, -4.9867, -0.9939, -4.9957},
                            Row{10.5, 0, -5, 0, -5}, Row{12, 1, -5, 1, -5}}) {
        auto const [steel, steel_spin] = rebound(scene::steel, row.tangential, dem::Lever::radius);
        auto const [plastic, plastic_spin] = rebound(scene::polyethylene, row.tangential, dem::Lever::radius);
        EXPECT_NEAR(steel, row.steel, 5e-3) << row.tangential;
        EXPECT_NEAR(steel_spin, row.steel_spin, 5e-3) << row.tangential;
        EXPECT_NEAR(plastic, row.plastic, 5e-3) << row.tangential;
        EXPECT_NEAR(plastic_spin, row.plastic_spin, 5e-3) << row.tangential;
    }
    EXPECT_NEAR(rebound(scene::steel, 12, dem::Lever::contact_point)[0], 1.0132, 5e-3);
    EXPECT_NEAR(rebound(scene::steel, 5.25, dem::Lever::contact_point)[0], -1.2576, 5e-3);
    EXPECT_NEAR(rebound(scene::polyethylene, 12, dem::Lever::contact_point)[0], 1.0544, 5e-3);
    EXPECT_NEAR(rebound(scene::polyethylene, 5.25, dem::Lever::contact_point)[0], -1.4569, 5e-3);
}

TEST(SpinningSphere, on_a_plane_keeps_its_angular_momentum_about_the_contact_and_reaches_the_tabulated_speed)
{
    struct Row
    {
        double spin, speed, spin_after, speed_tolerance, spin_tolerance;
    };
    // The row of 4 rad/s switches between stick and slip near the end and does not converge with the step.
    for (auto const& row :
         {Row{0.175, -0.00480, 0.0549, 1e-4, 1e-3}, Row{1, -0.02767, 0.3082, 1e-4, 2e-3},
          Row{2, -0.06466, 0.3836, 2e-4, 4e-3}, Row{4, -0.11884, 1.0291, 5e-4, 1e-2}, Row{6, -0.12, 3, 1e-3, 1e-3},
          Row{14, -0.12, 11, 1e-3, 1e-3}, Row{21, -0.12, 18, 1e-3, 1e-3}}) {
        // Spin about -y: the contact point then moves along +x and friction pushes the sphere back.
        auto const after = impact_on_plane(scene::aluminium_alloy_oblique, 0.1, {0, 0, -0.2},
                                           {.restitution = 0.5, .sliding_friction = 0.4}, {0, -row.spin, 0});
        EXPECT_NEAR(after.velocity.x, -0.4 * 0.1 * (row.spin + after.spin.y), 1e-9);
        EXPECT_NEAR(after.velocity.z, 0.1, 5e-4);
        EXPECT_NEAR(after.velocity.x, row.speed, row.speed_tolerance) << row.spin;
        EXPECT_NEAR(-after.spin.y, row.spin_after, row.spin_tolerance) << row.spin;
    }
}

TEST(SpinningSphere, against_its_like_does_as_on_a_plane)
{
    struct Row
    {
        Stuff stuff;
        double spin, speed, spin_after, speed_tolerance, spin_tolerance;
    };
    for (auto const& row : {Row{scene::aluminium_alloy_oblique, 1, -0.02767, 0.3082, 1e-4, 2e-3},
                            Row{scene::copper, 2, -0.06501, 0.3748, 2e-4, 4e-3},
                            Row{scene::aluminium_alloy_oblique, 21, -0.12, 18, 1e-3, 1e-3}}) {
        auto scene =
            scene::two_spheres(row.stuff, 0.1, 0.2, {.restitution = 0.5, .sliding_friction = 0.4}, {0, 0, row.spin});
        scene.settings.laws.lever = dem::Lever::radius;
        scene.prepare();
        double const modulus = 0.5 * wall_modulus(row.stuff), mass = 0.5 * sphere_mass(row.stuff, 0.1);
        scene::run_impact(scene, scene::hertz_time(modulus, 0.05, mass, 0.4) / 4000);
        auto const left = scene.row(0), right = scene.row(1);
        EXPECT_NEAR(scene.granules.velocity[left].y, -scene.granules.velocity[right].y, 1e-12);
        EXPECT_NEAR(std::abs(scene.granules.velocity[left].y), -row.speed, row.speed_tolerance);
        EXPECT_NEAR(scene.granules.spin[left].z, row.spin_after, row.spin_tolerance);
        EXPECT_NEAR(scene.granules.spin[right].z, row.spin_after, row.spin_tolerance);
    }
}

TEST(SpinningSphere, against_one_five_times_as_large_and_far_heavier_does_as_on_a_plane)
{
    scene::Stuff const& stuff = scene::aluminium_alloy_oblique;
    double const radius = 0.1, large = 0.5;
    scene::Scene scene(stuff, {.restitution = 0.5, .sliding_friction = 0.4});
    scene.settings.laws.lever = dem::Lever::radius;
    scene.add({0, 0, radius * (1 + 1e-9)}, {0, 0, -0.2}, radius, stuff.density, {0, -6, 0});
    scene.add({0, 0, -large}, {}, large, 1000 * stuff.density);
    scene.prepare();
    scene::run_impact(scene,
                      scene::hertz_time(0.5 * wall_modulus(stuff), 0.5 / 6, sphere_mass(stuff, radius), 0.2) / 4000);
    auto const row = scene.row(0);
    EXPECT_NEAR(scene.granules.velocity[row].x, -0.12, 1e-3);
    EXPECT_NEAR(-scene.granules.spin[row].y, 3, 5e-3);
    EXPECT_NEAR(scene.granules.velocity[row].z, 0.1, 5e-4);
}
}
