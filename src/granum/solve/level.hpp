// One level of the multigrid: the cells of a rank in single precision, apart by colour.
//
// Cells are of colour 0 or 1 by the parity of the sum of their global indices, so that the neighbours of a cell have
// the other colour. Strides along rows and layers are odd. Then the parity of a cell's number is its colour, each
// colour lies contiguous, and a sweep over it is one plain loop over the level, ghosts between rows included.
#pragma once

#include "granum/solve/exchange.hpp"

#include <optional>

namespace granum::solve
{
class Level
{
  public:
    //! The cells of a rank. `order`: directions, that contiguous in memory first. Collective.
    Level(grid::Layout const& layout, int rank, std::array<std::size_t, 3> const& order, par::Communicator const& comm);

    grid::Layout layout;
    std::array<std::size_t, 3> order;
    std::array<int, 3> n{}, lower{};  //!< cells; global index of the first
    std::array<std::ptrdiff_t, 3> strides{};

    std::array<Values, 3> link;  //!< per lower face, as in System
    Values extra;
    Values diagonal, inverse;   //!< 0 in ghosts and in cells that are left out
    Values right, x, residual;  //!< right: 0 in ghosts

    //! Number of a cell by its local indices.
    Index number(std::array<int, 3> const& cell) const
    {
        return static_cast<Index>(origin_ + cell[0] * strides[0] + cell[1] * strides[1] + cell[2] * strides[2]);
    }
    //! Where the cell of a number stands in a field. Those of numbers 2 apart stand side by side.
    Index place(Index number) const { return (number >> 1) + (number & 1) * half_; }

    long cells() const { return static_cast<long>(layout.cells[0]) * layout.cells[1] * layout.cells[2]; }
    //! Whether cells of the same colour meet over some periodic face. In a sweep over their colour, these see what the
    //! others were before.
    bool meets_itself() const { return meets_itself_; }
    //! Whether the links of a direction lead from cells to themselves.
    bool idle(std::size_t d) const { return layout.periodic[d] && layout.cells[d] == 1; }

    //! Calls visit(number of the first cell) for each row of owned cells.
    template <class Visitor>
    void for_rows(Visitor&& visit) const
    {
        std::array<int, 3> cell{};
        if (n[order[0]] == 0) return;
        for (cell[order[2]] = 0; cell[order[2]] < n[order[2]]; ++cell[order[2]])
            for (cell[order[1]] = 0; cell[order[1]] < n[order[1]]; ++cell[order[1]]) visit(number(cell));
    }

    //! Fills ghosts of links and extras and makes the diagonal. Returns the sums of the links of this rank. Collective.
    std::array<double, 3> close();
    //! Solves the equations of the cells of one colour for these: where x is zero, or for any x.
    void start(std::size_t colour);
    void relax(std::size_t colour);
    //! Residual of the cells of one colour.
    void find_residual(std::size_t colour);
    //! Right side times x, of this rank.
    double dot() const;
    //! Fills ghosts after the cells of one colour have changed. Collective.
    void refresh(Values& field, std::size_t colour) const;

  private:
    struct Span
    {
        Index first, end;  // places within a colour
    };
    Span span(std::size_t colour, Index first, Index last) const;  // between two cells, both included

    std::ptrdiff_t origin_ = 0;
    Index half_ = 0;
    bool meets_itself_ = false;
    std::array<Span, 2> all_{};
    std::optional<Exchange> exchange_;
};
}
