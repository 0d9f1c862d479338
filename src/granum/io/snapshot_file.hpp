// The latest state of a run, as much of it as the report shows: granules, droplets, gas in the mid-plane, the chamber.
#pragma once

#include "granum/geometry/chamber.hpp"
#include "granum/math/vec3.hpp"

#include <array>
#include <string>
#include <vector>

namespace granum::io
{
using math::Vec3;

//! One row per parcel.
struct GranuleView
{
    std::vector<Vec3> position;       //!< m
    std::vector<Vec3> velocity;       //!< m/s
    std::vector<Vec3> spin;           //!< rad/s
    std::vector<double> id;           //!< identity
    std::vector<double> material;     //!< number of the material
    std::vector<double> mass;         //!< of the parcel, kg
    std::vector<double> radius;       //!< of the parcel, m
    std::vector<double> temperature;  //!< K
    std::vector<double> moisture;     //!< kg water per kg dry granule
    std::vector<double> diameter;     //!< of one real granule, m
    std::vector<double> count;        //!< real granules in the parcel
    std::vector<double> porosity;     //!< mean of the layer; NaN without a layer
    std::vector<double> layer_mass;   //!< kg of dried solids
};

//! One row per droplet parcel.
struct DropletView
{
    std::vector<Vec3> position;    //!< m
    std::vector<double> diameter;  //!< m
};

//! Gas in the plane y = `Snapshot::mid_plane`, x fastest. A field may be left empty.
struct GasSlice
{
    int nx = 0, nz = 0;
    double x0 = 0, z0 = 0;                 //!< lower corner, m
    double dx = 0, dz = 0;                 //!< m
    std::vector<double> speed;             //!< m/s
    std::vector<double> temperature;       //!< K
    std::vector<double> humidity;          //!< kg/kg dry
    std::vector<double> voidage;           //!< 1
    std::vector<double> drying_potential;  //!< local, 1
    std::vector<double> open;              //!< > 0 inside the chamber
};

struct Snapshot
{
    double time = 0;                             //!< s
    double mid_plane = 0;                        //!< y of the cut, m
    std::vector<std::array<double, 2>> outline;  //!< corners (x, z) of the chamber in the cut, m; NaN: a break
    std::vector<Vec3> nozzles;                   //!< m
    GranuleView granules;
    DropletView droplets;
    GasSlice gas;
};

//! Corners (x, z) of the chamber cut at its middle, and the y of that cut; with bodies, pieces between breaks.
std::vector<std::array<double, 2>> mid_plane_outline(geometry::Chamber const& chamber);
double mid_plane(geometry::Chamber const& chamber);

//! Replaces `path` at once, so that a killed run leaves the last complete state. Throws base::IoError.
void write_snapshot(std::string const& path, Snapshot const& snapshot);
Snapshot read_snapshot(std::string const& path);
}
