// The curves of a real run laid over those of a simulated one, the offsets, and what is likely behind them.
#pragma once

#include <string>
#include <vector>

namespace granum::study
{
//! A quantity that both have.
struct Compared
{
    std::string name;                       //!< column of timeseries.csv
    std::vector<double> time, ours;         //!< of the run, s and SI
    std::vector<double> plant_time, plant;  //!< as logged, with the run's zero of time
    double mean = 0, plant_mean = 0;        //!< over the steady part that both have; SI
    double offset = 0, error = 0;           //!< ours less the plant's, and its standard error
    double deviation = 0;                   //!< root mean square of the difference over all that both have
    double tolerance = 0;                   //!< within which instruments agree
    bool agrees = false;                    //!< within the tolerance or two standard errors
    bool settled = false;                   //!< the difference has a steady part
};

struct Comparison
{
    std::string folder, plant;
    double from = 0, to = 0;  //!< s, what both have
    std::vector<Compared> quantities;
    std::vector<std::string> causes;  //!< sentences
    std::vector<std::string> left;    //!< columns of the plant's file that nothing is known of

    std::string not_read() const;  //!< their names in one line
};

//! @param shift time of the plant's log at which the run begins, s
//! Columns of the plant's file (io::read_logged) are those of timeseries.csv, or words of the trade for them: exhaust
//! or outlet temperature, product or bed temperature. Throws base::CaseError where the file is wrong, shares no column
//! or no time with the run; base::IoError where the run folder is none.
Comparison compare(std::string const& folder, std::string const& plant, double shift);

//! compare.csv and compare.html in the run folder.
void write(Comparison const& comparison);

//! A value for people: in degC, g/kg, Pa ..., with its unit. `difference`: of two of them.
std::string shown(std::string const& name, double value, bool difference = false);
}
