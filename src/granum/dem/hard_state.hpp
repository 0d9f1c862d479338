// Hard spheres in flight: each at the place and velocity it had at its own last event.
//
// A sphere moves on a parabola until something happens to it, so nobody else's events touch its row: position and
// velocity at a later time are a formula. Times count from the beginning of the present span of the engine.
#pragma once

#include "granum/math/vec3.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace granum::dem
{
using math::Vec3;

//! What a prediction reads of a sphere: one cache line.
struct HardBody
{
    Vec3 x, v;      //!< m, m/s, at time t
    double t;       //!< s
    double radius;  //!< m
};

struct HardState
{
    std::vector<HardBody> body;
    std::vector<Vec3> spin;    //!< rad/s
    std::vector<double> mass;  //!< kg
    std::vector<double> last;  //!< time of the last collision, s
    std::vector<std::uint32_t> material;
    std::vector<Vec3> own;  //!< acceleration of each, m/s2; empty where `common` is that of all
    Vec3 common;            //!< m/s2
    Vec3 lower, upper;      //!< of the domain, m
    std::array<bool, 3> periodic{};

    std::size_t size() const { return body.size(); }
    bool uniform() const { return own.empty(); }
    Vec3 const& acceleration(std::size_t i) const { return own.empty() ? common : own[i]; }

    Vec3 position(std::size_t i, double time) const
    {
        HardBody const& b = body[i];
        double const s = time - b.t;
        return b.x + s * (b.v + (0.5 * s) * acceleration(i));
    }
    Vec3 velocity(std::size_t i, double time) const { return body[i].v + (time - body[i].t) * acceleration(i); }
    //! Moves the row itself on to `time`.
    void bring(std::size_t i, double time)
    {
        HardBody& b = body[i];
        b.x = position(i, time);
        b.v = velocity(i, time);
        b.t = time;
    }
    //! The image of a distance vector that is nearest to zero.
    Vec3 nearest(Vec3 apart) const
    {
        for (std::size_t d = 0; d < 3; ++d) {
            if (!periodic[d]) continue;
            double const width = upper[d] - lower[d];
            if (apart[d] > 0.5 * width)
                apart[d] -= width;
            else if (apart[d] < -0.5 * width)
                apart[d] += width;
        }
        return apart;
    }
};
}
