// Heat through the circle in which spheres touch.
#include "granum/law/conduction/all.hpp"
#include "granum/law/conduction/softened.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace granum::law;

TEST(ContactConduction, has_the_circle_of_the_published_pair)
{
    // Spheres of 3 and 3.6 mm with an overlap of 0.133 um: a lens of 14.74 um.
    double const reduced = 1.5e-3 * 1.8e-3 / 3.3e-3;
    EXPECT_NEAR(conduction::Lens{}({reduced, 1.33e-7}), 1.474e-5, 0.002e-5);
    EXPECT_NEAR(conduction::Lens{}({reduced, 1.33e-7}) / conduction::Hertz{}({reduced, 1.33e-7}), std::sqrt(2), 1e-12);
}

TEST(ContactConduction, of_every_law_is_nothing_without_overlap_and_grows_with_it)
{
    for (auto const& name : conduction::All::names()) {
        SCOPED_TRACE(name);
        auto const law = *conduction::All::make(name);
        EXPECT_EQ(conduction::circle(law, {1e-3, 0}), 0);
        double const shallow = conduction::circle(law, {1e-3, 1e-7}), deep = conduction::circle(law, {1e-3, 4e-7});
        EXPECT_DOUBLE_EQ(deep, 2 * shallow);
        EXPECT_EQ(shallow > 0, name != "none");
    }
}

TEST(ContactConduction, puts_both_sides_in_series)
{
    EXPECT_DOUBLE_EQ(conduction::conductance(1e-5, 3, 3), 2 * 3 * 1e-5);  // 2 k a of equal spheres
    EXPECT_DOUBLE_EQ(conduction::conductance(1e-5, 0, 3), 0);
    EXPECT_DOUBLE_EQ(conduction::conductance(1e-5, 0, 0), 0);
    EXPECT_NEAR(conduction::conductance(1e-5, 3, 1e9), 4 * 3 * 1e-5, 1e-12);  // into a body of one temperature
}

TEST(ContactConduction, finds_the_overlap_of_a_force)
{
    // F = 4/3 E* sqrt(R*) d^(3/2)
    double const modulus = 5e7, reduced = 4e-4, overlap = 3e-7;
    double const force = 4.0 / 3 * modulus * std::sqrt(reduced) * std::pow(overlap, 1.5);
    EXPECT_NEAR(conduction::overlap_at(force, reduced, modulus), overlap, 1e-14 * overlap);
    EXPECT_EQ(conduction::overlap_at(0, reduced, modulus), 0);
}

// One Hertzian collision, m x'' = -4/3 E sqrt(R) x^(3/2), by small steps: duration and integral of the circle that
// `circle` makes of the force.
template <class Circle>
std::pair<double, double> collide(double modulus, double reduced, Circle&& circle)
{
    double const mass = 2e-7, step = 1e-5 * std::pow(mass * mass / (reduced * modulus * modulus), 0.2);
    double overlap = 0, speed = 1, time = 0, sum = 0;
    do {
        overlap += 0.5 * step * speed;
        double const force = 4.0 / 3 * modulus * std::sqrt(reduced) * std::pow(std::max(overlap, 0.0), 1.5);
        sum += step * circle(force);
        speed -= step * force / mass;
        overlap += 0.5 * step * speed;
        time += step;
    } while (overlap > 0);
    return {time, sum};
}

TEST(ContactConduction, takes_back_what_softening_adds_to_the_heat_of_a_collision)
{
    double const soft = 1e7, real = 1e9, reduced = 4e-4;
    auto const true_circle = [&](double force) {
        return conduction::Hertz{}({reduced, conduction::overlap_at(force, reduced, real)});
    };
    auto const [soft_time, corrected] =
        collide(soft, reduced, true_circle);  // softened motion, circle of the real modulus
    auto const [real_time, exact] = collide(real, reduced, true_circle);
    EXPECT_NEAR(conduction::duration_ratio(soft, real), real_time / soft_time, 1e-4 * real_time / soft_time);
    EXPECT_NEAR(conduction::short_contact_factor(soft, real) * corrected, exact, 1e-4 * exact);
    EXPECT_DOUBLE_EQ(conduction::short_contact_factor(real, real), 1);
}
