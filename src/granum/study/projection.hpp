// From the seconds of a run to the hours of its batch: the run's porosity and overspray drive a population balance of
// its granules.
#pragma once

#include "granum/study/size_growth.hpp"

#include <optional>
#include <string>
#include <vector>

namespace granum::study
{
//! How granules are fed and taken out; nothing: a batch.
struct Continuous
{
    double feed = 0;        //!< kg/s of cores as those of the run
    double diameter = 0;    //!< m, that half of the granules of this size are let through
    double sharpness = 20;  //!< a of 1 / (1 + (diameter / d)^a)
};

//! Solids that the run lost as dust, as far as they stay in the bed as seeds of new granules.
struct Nuclei
{
    double kept = 0;      //!< share of the overspray
    double diameter = 0;  //!< m
};

//! What is added to the layering that the run tells of.
struct Besides
{
    Nuclei nuclei;
    double agglomeration = 0;  //!< 1/s, share of the granules that join others at the beginning; any pair alike
};

struct Projected
{
    double time = 0;                   //!< s
    double d10 = 0, d50 = 0, d90 = 0;  //!< m, by volume
    double d50_low = 0, d50_high = 0;  //!< with the ends of the porosity's 95 % interval
    double layer = 0;  //!< m, mean over granules of a batch: half of what diameters have grown; not of agglomerates
    double mass = 0;   //!< kg of dry granules in the bed
    double discharged = 0;  //!< kg/s
    double variation = 0;   //!< standard deviation of the layer's mass among granules over its mean; batch
};

struct Projection
{
    double porosity = 0, porosity_low = 0, porosity_high = 0;
    double overspray = 0;      //!< share of the solids that leave or stay on walls
    double nuclei_rate = 0;    //!< new granules per second
    double abraded = 0;        //!< share of the solids that is rubbed off layers again
    double agglomeration = 0;  //!< as given, 1/s
    SizeGrowth growth;         //!< of large granules against small ones
    double moisture = 0;       //!< kg/kg, residual
    double solids_rate = 0;    //!< kg/s
    std::vector<Projected> rows;
};

//! Takes the case, the summary and the last state of a run folder. The size of a granule matters for its growth as far
//! as the run's granules of different sizes tell (by two standard errors at least); porosity, overspray and air stay
//! those of the run. Throws base::IoError or base::CaseError where the run cannot tell what is needed.
Projection project(std::string const& folder, double hours, std::optional<Continuous> const& continuous,
                   Besides const& besides = {}, int rows = 121);

//! project.csv and project.html in the run folder.
void write(Projection const& projection, std::string const& folder);
}
