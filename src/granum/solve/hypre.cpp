#include "granum/solve/hypre.hpp"

#include "granum/base/error.hpp"

#include <HYPRE.h>
#include <HYPRE_struct_ls.h>

#include <array>
#include <vector>

namespace granum::solve
{
namespace
{
constexpr int most_solves_per_set_up = 200;
constexpr int patience = 3;  // iterations above those right after a set-up

//! Owned cells as hypre counts them: x fastest.
template <class Visitor>
void for_box(grid::Grid const& grid, Visitor&& visit)
{
    for (int k = 0; k < grid.n[2]; ++k)
        for (int j = 0; j < grid.n[1]; ++j)
            for (int i = 0; i < grid.n[0]; ++i) visit(grid.at(i, j, k));
}

void start_hypre_once()
{
    static bool const started = [] { return HYPRE_Init() == 0; }();
    base::require(started, "hypre does not start");
}
}

struct Hypre::Inside
{
    grid::Grid const& grid;
    par::Communicator const& comm;
    Method method;
    std::vector<grid::Run> lines;
    HYPRE_StructGrid cells = nullptr;
    HYPRE_StructStencil stencil = nullptr;
    HYPRE_StructMatrix matrix = nullptr;
    HYPRE_StructVector right = nullptr, solution = nullptr;
    HYPRE_StructSolver cycle = nullptr;
    std::array<HYPRE_Int, 3> low{}, high{};
    std::vector<double> packed;
    Field residual, result;
    Pressure::Memory memory;  //!< fresh_iterations: of the first solve after a set-up, -1: none yet

    Inside(grid::Grid const& g, par::Communicator const& c, Method m)
        : grid(g),
          comm(c),
          method(m),
          lines(grid::runs(g, [](int, int, int, grid::Index) { return true; })),
          residual(g.make_field()),
          result(g.make_field())
    {
        start_hypre_once();
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = grid.shift[d];
            high[d] = grid.shift[d] + grid.n[d] - 1;
        }
        HYPRE_StructGridCreate(comm.handle(), 3, &cells);
        HYPRE_StructGridSetExtents(cells, low.data(), high.data());
        std::array<HYPRE_Int, 3> period{};
        for (std::size_t d = 0; d < 3; ++d) period[d] = grid.periodic[d] && grid.global[d] > 1 ? grid.global[d] : 0;
        HYPRE_StructGridSetPeriodic(cells, period.data());
        HYPRE_StructGridAssemble(cells);

        // Symmetric storage: the cell itself and its upper neighbours.
        HYPRE_StructStencilCreate(3, 4, &stencil);
        HYPRE_Int offsets[4][3]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int entry = 0; entry < 4; ++entry) HYPRE_StructStencilSetElement(stencil, entry, offsets[entry]);

        for (HYPRE_StructVector* vector : {&right, &solution}) {
            HYPRE_StructVectorCreate(comm.handle(), cells, vector);
            HYPRE_StructVectorInitialize(*vector);
            HYPRE_StructVectorAssemble(*vector);
        }
        packed.resize(static_cast<std::size_t>(grid.n[0]) * grid.n[1] * grid.n[2] * 4);
    }
    ~Inside()
    {
        drop();
        HYPRE_StructVectorDestroy(right);
        HYPRE_StructVectorDestroy(solution);
        HYPRE_StructStencilDestroy(stencil);
        HYPRE_StructGridDestroy(cells);
    }
    Inside(Inside const&) = delete;
    Inside& operator=(Inside const&) = delete;

    void drop()
    {
        if (cycle) method == Method::pfmg ? HYPRE_StructPFMGDestroy(cycle) : HYPRE_StructSMGDestroy(cycle);
        if (matrix) HYPRE_StructMatrixDestroy(matrix);
        cycle = nullptr;
        matrix = nullptr;
    }

    //! Of the matrix in memory.
    void set_up()
    {
        drop();
        HYPRE_StructMatrixCreate(comm.handle(), cells, stencil, &matrix);
        HYPRE_StructMatrixSetSymmetric(matrix, 1);
        HYPRE_StructMatrixInitialize(matrix);
        std::size_t next = 0;
        for_box(grid, [&](grid::Index cell) {
            double const own = memory.diagonal[cell];
            packed[next++] = own > 0 ? own : 1;  // a cell left out stands alone
            for (std::size_t d = 0; d < 3; ++d)
                packed[next++] = grid.periodic[d] && grid.global[d] == 1 ? 0 : -memory.link[d][grid.next(cell, d)];
        });
        HYPRE_Int entries[4]{0, 1, 2, 3};
        HYPRE_StructMatrixSetBoxValues(matrix, low.data(), high.data(), 4, entries, packed.data());
        HYPRE_StructMatrixAssemble(matrix);
        if (method == Method::pfmg)
            set_up_pfmg();
        else
            set_up_smg();
        HYPRE_ClearAllErrors();
    }

    void set_up_pfmg()
    {
        HYPRE_StructPFMGCreate(comm.handle(), &cycle);
        HYPRE_StructPFMGSetMaxIter(cycle, 1);
        HYPRE_StructPFMGSetTol(cycle, 0.0);
        HYPRE_StructPFMGSetZeroGuess(cycle);
        // Symmetric, as conjugate gradients ask: red-black, but weighted Jacobi in a periodic box, whose coarsest cells
        // are their own neighbours and have no two colours: red-black does not converge there.
        bool const wraps = grid.periodic[0] || grid.periodic[1] || grid.periodic[2];
        HYPRE_StructPFMGSetRelaxType(cycle, wraps ? 1 : 2);
        HYPRE_StructPFMGSetRAPType(cycle, 0);
        HYPRE_StructPFMGSetSkipRelax(cycle, 1);
        HYPRE_StructPFMGSetNumPreRelax(cycle, 1);
        HYPRE_StructPFMGSetNumPostRelax(cycle, 1);
        HYPRE_StructPFMGSetPrintLevel(cycle, 0);
        HYPRE_StructPFMGSetLogging(cycle, 0);
        HYPRE_StructPFMGSetup(cycle, matrix, right, solution);
    }

    void set_up_smg()
    {
        HYPRE_StructSMGCreate(comm.handle(), &cycle);
        HYPRE_StructSMGSetMaxIter(cycle, 1);
        HYPRE_StructSMGSetTol(cycle, 0.0);
        HYPRE_StructSMGSetZeroGuess(cycle);
        HYPRE_StructSMGSetNumPreRelax(cycle, 1);
        HYPRE_StructSMGSetNumPostRelax(cycle, 1);
        HYPRE_StructSMGSetPrintLevel(cycle, 0);
        HYPRE_StructSMGSetLogging(cycle, 0);
        HYPRE_StructSMGSetup(cycle, matrix, right, solution);
    }
};

Hypre::Hypre(grid::Grid const& grid, par::Communicator const& comm, Method method)
    : inside_(std::make_unique<Inside>(grid, comm, method))
{
}
Hypre::~Hypre() = default;

bool Hypre::suits(grid::Grid const& grid)
{
    for (std::size_t d = 0; d < 3; ++d)
        if (grid.periodic[d] && (grid.global[d] & (grid.global[d] - 1)) != 0) return false;
    return true;
}

void Hypre::set_up(System const& system, Field const& diagonal, Facts const& facts)
{
    Inside& in = *inside_;
    if (!in.memory.stale && in.memory.solves < most_solves_per_set_up) return;
    // The preconditioner must not be singular: there a part of the diagonal is added that no mode but the constant
    // feels.
    Field raised = diagonal;
    if (facts.free)
        for (double& value : raised) value *= 1 + 1e-4;
    in.memory = {.set_up = true, .stale = false, .diagonal = std::move(raised), .link = system.link};
    in.set_up();
}

void Hypre::take(std::size_t line, double const* residual)
{
    auto const& run = inside_->lines[line];
    std::copy(residual, residual + (run.end - run.first),
              inside_->residual.begin() + static_cast<std::ptrdiff_t>(run.first));
}

double Hypre::apply()
{
    Inside& in = *inside_;
    std::size_t next = 0;
    for_box(in.grid, [&](grid::Index cell) { in.packed[next++] = in.residual[cell]; });
    HYPRE_StructVectorSetBoxValues(in.right, in.low.data(), in.high.data(), in.packed.data());
    HYPRE_StructVectorSetConstantValues(in.solution, 0.0);
    if (in.method == Method::pfmg)
        HYPRE_StructPFMGSolve(in.cycle, in.matrix, in.right, in.solution);
    else
        HYPRE_StructSMGSolve(in.cycle, in.matrix, in.right, in.solution);
    HYPRE_ClearAllErrors();  // one cycle never "converges"; the outer iteration judges
    HYPRE_StructVectorGetBoxValues(in.solution, in.low.data(), in.high.data(), in.packed.data());
    next = 0;
    double product = 0;
    for_box(in.grid, [&](grid::Index cell) {
        in.result[cell] = in.packed[next++];
        product += in.result[cell] * in.residual[cell];
    });
    return product;
}

void Hypre::give(std::size_t line, double* result) const
{
    auto const& run = inside_->lines[line];
    std::copy(inside_->result.begin() + static_cast<std::ptrdiff_t>(run.first),
              inside_->result.begin() + static_cast<std::ptrdiff_t>(run.end), result);
}

void Hypre::served(int iterations)
{
    auto& memory = inside_->memory;
    if (!memory.set_up) return;
    ++memory.solves;
    if (memory.fresh_iterations < 0) memory.fresh_iterations = iterations;
    memory.stale = iterations > memory.fresh_iterations + patience;
}

Pressure::Memory const& Hypre::memory() const
{
    return inside_->memory;
}

void Hypre::recall(Pressure::Memory memory)
{
    inside_->memory = std::move(memory);
    if (inside_->memory.set_up) inside_->set_up();
}
}
