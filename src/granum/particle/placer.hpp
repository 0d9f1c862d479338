// Finds room for spheres at random: centres in a box that meet neither each other nor whatever else the caller refuses.
//
// Spheres of different size lie in lists of their own (each for sizes within a factor of two), so that the cost of a
// trial does not grow with the ratio of the sizes.
#pragma once

#include "granum/base/random.hpp"
#include "granum/math/vec3.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace granum::particle
{
using math::Vec3;

class Placer
{
  public:
    //! For spheres with radii from `smallest` to `largest` (m) in the box from `lower` to `upper` (m).
    Placer(Vec3 const& lower, Vec3 const& upper, double smallest, double largest);

    //! Notes a sphere that is there; it may reach out of the box.
    void add(Vec3 const& centre, double radius);

    //! True where a sphere would meet none of those noted.
    bool free(Vec3 const& centre, double radius) const;

    //! Tries centres at random between `low` and `high` (m, within the box) until one is free and accepted, and notes
    //! the sphere there. Nothing after `trials` failures.
    std::optional<Vec3> place(double radius, Vec3 const& low, Vec3 const& high, base::Random& random, int trials,
                              std::function<bool(Vec3 const&)> const& accepted);

  private:
    struct Sphere
    {
        Vec3 centre;
        double radius;
        std::int32_t next;  // in the same cell, or -1
    };
    struct Level
    {
        double largest = 0, edge = 0;  // largest radius, width of the cells
        std::array<long, 3> cells{};
        std::vector<std::int32_t> first;  // sphere per cell, or -1
    };
    std::array<long, 3> cell_of(Level const& level, Vec3 const& x) const;

    Vec3 lower_;
    double smallest_;
    std::vector<Level> levels_;
    std::vector<Sphere> spheres_;
};
}
