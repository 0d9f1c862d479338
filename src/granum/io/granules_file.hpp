// Granules one by one from a CSV file, in SI units: where they are, how they move, what they are made of.
#pragma once

#include "granum/math/vec3.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace granum::io
{
struct GranuleRecord
{
    int line = 0;  //!< of the file
    std::uint64_t id = 0;
    math::Vec3 position;   //!< m
    double radius = 0;     //!< m
    math::Vec3 velocity;   //!< m/s
    math::Vec3 spin;       //!< rad/s
    std::string material;  //!< empty where the file does not say
};

//! Identities in a file are below this, so that lists by identity stay affordable.
inline constexpr std::uint64_t largest_id = 100'000'000;

//! Columns id,x,y,z,radius and, if there, vx,vy,vz, then wx,wy,wz, then material; a first line may name them, in any
//! order. Lines that are empty or begin with # are left out. Throws base::CaseError with file and line: unreadable, a
//! field that is not a number, a radius not above 0, an identity that was there before.
std::vector<GranuleRecord> read_granules(std::string const& path);
}
