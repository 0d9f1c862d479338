// The contact laws of a run and what they need to know about each pairing of materials.
#pragma once

#include "granum/law/contact/all.hpp"

#include <cstdint>
#include <vector>

namespace granum::dem
{
//! Elasticity of a material that touches.
struct Material
{
    double youngs_modulus = 1e7;  //!< Pa, usually softened
    double poisson_ratio = 0.25;
    bool rigid = false;  //!< does not yield: only the partner's elasticity counts; of walls only
    bool wall = false;   //!< of walls only
};

//! How two materials touch.
struct PairProperties
{
    double restitution = 0.8;
    double sliding_friction = 0.3;
    double rolling_friction = 0;
    double rolling_damping = 0.3;       //!< eta_r of `epsd-dashpot`
    double stiffness = 1000;            //!< k_n of `linear`, N/m
    double tangential_ratio = 2.0 / 7;  //!< k_t over k_n of `linear`
};

//! The granule and the speed for which a restitution that depends on the speed is meant.
struct ReferenceImpact
{
    double radius = 0.5e-3;  //!< m
    double density = 1500;   //!< kg/m3
    double speed = 1;        //!< of approach, m/s
};

//! Where the contact force acts, seen from the centre.
enum class Lever
{
    contact_point,  //!< R - overlap/2
    radius          //!< R
};

//! One law per slot, as chosen in the case, and the table of materials.
struct Laws
{
    law::contact::NormalLaws::Any normal;
    law::contact::TangentialLaws::Any tangential;
    law::contact::RollingLaws::Any rolling;
    Lever lever = Lever::contact_point;
    ReferenceImpact reference;
    std::vector<Material> materials;

    //! Adds a material and returns its index; its pairings start with PairProperties' defaults.
    std::uint32_t add(Material const& material);
    //! Sets how materials a and b touch, in both orders.
    void pair(std::uint32_t a, std::uint32_t b, PairProperties const& properties);
    PairProperties const& pair(std::uint32_t a, std::uint32_t b) const;
    //! True where only walls are made of the material.
    bool is_wall(std::uint32_t material) const;

    //! What the laws are given for materials a and b: the harmonic moduli and the damping of the normal law.
    law::contact::Pair<double> effective(std::uint32_t a, std::uint32_t b) const;

  private:
    std::vector<std::vector<PairProperties>> pairs_;  // pairs_[high][low], a triangle
};
}
