// What stands between the residual and the next direction of conjugate gradients: an approximate inverse of the matrix,
// symmetric and positive.
#pragma once

#include "granum/solve/pressure.hpp"

namespace granum::solve
{
//! What was seen of a system on all ranks.
struct Facts
{
    bool free = false;    //!< x is determined up to a constant
    double diagonal = 0;  //!< largest
    double right = 0;     //!< two-norm of the right side
};

//! Residuals come and results go line by line (the runs of owned cells), so that they are met where they are made.
class Preconditioner
{
  public:
    virtual ~Preconditioner() = default;
    //! Called once in each solve. Collective.
    virtual void set_up(System const& system, Field const& diagonal, Facts const& facts) = 0;
    virtual void take(std::size_t line, double const* residual) = 0;
    //! Returns the residual times the result, of this rank. Collective.
    virtual double apply() = 0;
    virtual void give(std::size_t line, double* result) const = 0;

    //! Called after each solve.
    virtual void served(int) {}
    virtual Pressure::Memory const& memory() const
    {
        static Pressure::Memory const none;
        return none;
    }
    virtual void recall(Pressure::Memory) {}
};
}
