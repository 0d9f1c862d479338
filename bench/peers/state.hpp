// A state that every program of the comparison can load: spheres in an open box, as text, tiled to any size.
#pragma once

#include "granum/math/vec3.hpp"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace granum::peers
{
using math::Vec3;

struct Sphere
{
    Vec3 position;  //!< m
    double radius;  //!< m
    Vec3 velocity;  //!< m/s
    Vec3 spin;      //!< rad/s
};

//! Spheres of one density above the floor z = 0, between the walls x = 0, x = length_x, y = 0, y = length_y.
struct State
{
    double length_x = 0, length_y = 0;  //!< m
    double density = 0;                 //!< kg/m3
    std::vector<Sphere> spheres;
};

//! Reads "# lx=.. ly=.. rho=..", a line of column names and one line `id,x,y,z,radius,vx,vy,vz,wx,wy,wz` a sphere, ids
//! 1, 2, 3 and so on. Throws base::IoError with file and line of what it cannot read.
State read_state(std::filesystem::path const& path);

//! Writes the same. Throws base::IoError where the file cannot be written.
void write_state(State const& state, std::filesystem::path const& path);

//! The sphere in tile (i, j) of a state repeated along x and y. Every other tile is a mirror image, so that what
//! touched a side wall touches its own image with the same force and a settled bed stays settled.
Sphere in_tile(State const& state, Sphere sphere, long i, long j);
}
