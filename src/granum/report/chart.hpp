// Charts as SVG inside the page: curves, histograms and bars, with round ticks, axis labels and a legend that can be
// read without colour.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace granum::report
{
enum class Stroke
{
    solid,
    dashed,
    dotted
};

struct Curve
{
    std::string label;         //!< in the legend; empty: not there
    std::vector<double> x, y;  //!< NaN leaves a gap
    std::string colour = "#1b5e8c";
    Stroke stroke = Stroke::solid;
};

//! A horizontal or vertical line with a meaning: the balance's value, a mean.
struct Mark
{
    std::string label;
    double value;
};

struct Axis
{
    std::string label;  //!< with its unit: "bed temperature (°C)"
    bool logarithmic = false;
};

struct CurveChart
{
    Axis x, y;
    std::vector<Curve> curves;
    std::vector<Mark> levels;
};

//! Bars of a weighted distribution; weights are shown as shares in %.
struct HistogramChart
{
    Axis x;
    std::string y = "share of the dried solids (%)";
    std::span<double const> values, weights;
    std::vector<Mark> marks;                        //!< vertical lines
    std::optional<std::pair<double, double>> band;  //!< shaded interval
    int bins = 24;
};

//! Round numbers that cover [low, high]: about `count` of them, steps of 1, 2 or 5.
std::vector<double> ticks(double low, double high, int count);

//! An <svg> element; "" where there is nothing to draw.
std::string svg(CurveChart const& chart);
std::string svg(HistogramChart const& chart);

struct Share
{
    std::string label;
    double value;
};

//! One bar split into shares, each labelled with its percentage in a legend. "" where nothing is positive.
std::string split_bar(std::vector<Share> const& shares);
}
