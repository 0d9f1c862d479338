// The surface of single granules, cap by cap: where deposits lie over each other and where none has fallen yet.
//
// A granule of the simulation stands for many and knows only how much has been deposited on all of them. Here each of a
// sample of real granules has its sphere of panels, every dried deposit falls on it as often as chance (Poisson) has
// it, at places spread evenly over the sphere, and adds its height to the panels whose middles lie under it.
//
// Source: physics.md 5.5. Panels on granules are an idea of Jiang, Rieck, Bueck and Tsotsas (2020; abstract only).
#pragma once

#include "granum/base/random.hpp"
#include "granum/math/vec3.hpp"

#include <cstddef>
#include <vector>

namespace granum::product
{
class Surface
{
  public:
    //! Panels of equal area, their middles on a Fibonacci spiral.
    explicit Surface(std::size_t panels);

    //! A deposit of `volume` m3 (pores included) on a disc of `base_radius` about `direction` (unit) of a sphere of
    //! `radius`; m. Its height is the volume over the area of the disc on the sphere.
    void add(math::Vec3 const& direction, double radius, double base_radius, double volume);

    double coverage() const;        //!< share of the panels that have a deposit
    double mean_thickness() const;  //!< m, over all panels
    double variation() const;       //!< standard deviation of the thickness over its mean; 0 where there is none
    std::vector<double> const& thickness() const { return thickness_; }  //!< m

    math::Vec3 middle(std::size_t panel) const;  //!< unit vector

  private:
    std::vector<double> thickness_;
};

//! What a droplet parcel left, seen from one real granule.
struct Fall
{
    double per_granule;  //!< mean number of deposits on each real granule of the parcel
    double radius;       //!< of the granule, m
    double base_radius;  //!< of a deposit, m
    double volume;       //!< of a deposit when dry, pores included, m3
};

//! Deposits that chance lets fall on one granule.
void fall(Surface& surface, Fall const& what, base::Random& random);

struct SurfaceStatistics
{
    double coverage = 0;           //!< mean share of the surface under deposits
    double mean_thickness = 0;     //!< m
    double variation_within = 0;   //!< of the thickness over a granule, mean over those that have a layer
    double variation_between = 0;  //!< of the mean thickness among granules
    std::size_t granules = 0;
};
SurfaceStatistics statistics(std::vector<Surface> const& sample);
}
