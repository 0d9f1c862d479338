// What a property model is given about a piece of layer, and what it answers.
#pragma once

namespace granum::product
{
//! One dried deposit: how it came to be.
struct LayerElement
{
    double drying_potential;    //!< eta at impact, 1 in fresh air, 0 in saturated air
    double drying_time;         //!< s from impact to dry
    double moisture_at_impact;  //!< kg water per kg solids
};

//! A property with two standard deviations that must not be mixed: one averages out, the other does not.
struct Prediction
{
    double mean;
    double element;  //!< scatter of one element about the model, independent from element to element
    double common;   //!< uncertainty of the model itself, the same for every element of the product
};
}
