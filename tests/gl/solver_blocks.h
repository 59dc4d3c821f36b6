/* The rows of tests/gl/test_blocks.c of the blocks of the backend compute. */
#ifndef SLOSH_SOLVER_BLOCKS_H
#define SLOSH_SOLVER_BLOCKS_H

#include "shaders/sim/constant_block.h"
#include "shaders/sim/dfsph/dfsph_block.h"
#include "shaders/sim/exact_shapes_block.h"
#include "shaders/sim/flow_block.h"
#include "shaders/sim/flow_counts_block.h"
#include "shaders/sim/mesh_block.h"
#include "shaders/sim/mueller/mueller_block.h"
#include "shaders/sim/pbf/pbf_block.h"
#include "shaders/sim/solid_steps_block.h"
#include "shaders/sim/solve_block.h"
#include "shaders/sim/step_block.h"
#include "shaders/sim/term_block.h"
#include "shaders/sim/watch_block.h"
#include "shaders/sim/wcsph/wcsph_block.h"

#define CONSTANT(member)  MEMBER(ConstantBlock, member)
#define STEP(member)      MEMBER(StepBlock, member)
#define TERM(member)      MEMBER(TermBlock, member)
#define MUELLER(member)   MEMBER(MuellerBlock, member)
#define WCSPH(member)     MEMBER(WcsphBlock, member)
#define DFSPH(member)     MEMBER(DfsphBlock, member)
#define PBF(member)       MEMBER(PbfBlock, member)
#define WATCH(member)     MEMBER(WatchBlock, member)
#define STEPS(member)     MEMBER(SolidStepsBlock, member)
#define SHAPE(member)     MEMBER(ExactShapesBlock, member)
#define FLOW(member)      MEMBER(FlowBlock, member)
#define MESH(member)      MEMBER(MeshBlock, member)
#define COUNTS(member)    MEMBER(FlowCounts, member)
#define SOLVE(member)     MEMBER(SolveBlock, member)
#define GROUPS_OF(member) SOLVE(member.along), SOLVE(member.rows), SOLVE(member.deep), SOLVE(member.unused)

#define SOLVER_BLOCKS                                                                                        \
    BLOCK("sim/constant_block.h", ConstantBlock, CONSTANT(support), CONSTANT(inverse_support),               \
          CONSTANT(rest_number_density), CONSTANT(spacing), CONSTANT(kernel_scale),                          \
          CONSTANT(pressure_scale), CONSTANT(viscosity_scale), CONSTANT(stiffness_scale),                    \
          CONSTANT(inverse_unit), CONSTANT(unit_volume), CONSTANT(inverse_unit_volume),                      \
          CONSTANT(first_cell), CONSTANT(particle_total), CONSTANT(grid_size), CONSTANT(cell_total),         \
          CONSTANT(first_row), CONSTANT(last_row), CONSTANT(first_single_row), CONSTANT(last_single_row),    \
          CONSTANT(half_size), CONSTANT(wall_lift), CONSTANT(dimensions), CONSTANT(fluids[0].mass),          \
          CONSTANT(fluids[0].density), CONSTANT(fluids[0].stiffness), CONSTANT(fluids[0].viscosity),         \
          CONSTANT(fluids[7].viscosity), CONSTANT(cell_origin), CONSTANT(cell_inverse), CONSTANT(box_low),   \
          CONSTANT(box_whole), CONSTANT(cell_fold)),                                                         \
        BLOCK("sim/step_block.h", StepBlock, STEP(rotation[0]), STEP(omega0), STEP(drift_dt), STEP(omega1),  \
              STEP(still), STEP(shift), STEP(velocity_change), STEP(gravity), STEP(kick_dt),                 \
              STEP(apparent_origin), STEP(apparent_alpha), STEP(apparent_omega), STEP(kick_gravity)),        \
        BLOCK("sim/term_block.h", TermBlock, TERM(colour_scale), TERM(drag_range), TERM(friction_scale),     \
              TERM(curvature_least), TERM(curvature_whole), TERM(curvature_full), TERM(curvature_few),       \
              TERM(curvature_crowd), TERM(curvature_crowd_least), TERM(curvature_offset),                    \
              TERM(curvature_most), TERM(fluid_terms[0].tension), TERM(fluid_terms[0].wet),                  \
              TERM(fluid_terms[7].wet), TERM(drag_nodes), TERM(drag_steps), TERM(drag_offset),               \
              TERM(lid_velocity)),                                                                           \
        BLOCK("sim/mueller/mueller_block.h", MuellerBlock, MUELLER(boundary_fades), MUELLER(boundary_most)), \
        BLOCK("sim/wcsph/wcsph_block.h", WcsphBlock, WCSPH(gradient_scale), WCSPH(diffusion),                \
              WCSPH(radial_friction), WCSPH(shift_speed), WCSPH(density_return), WCSPH(boundary_fades),      \
              WCSPH(inverse_sound2), WCSPH(kernel_shape), WCSPH(corrected_gradient), WCSPH(any_artificial),  \
              WCSPH(wcsph_fluids[0].tait), WCSPH(wcsph_fluids[0].artificial_viscosity),                      \
              WCSPH(wcsph_fluids[7].artificial_viscosity)),                                                  \
        BLOCK("sim/dfsph/dfsph_block.h", DfsphBlock, DFSPH(gradient), DFSPH(boundary_fades),                 \
              DFSPH(lightest), DFSPH(coarse_slope), DFSPH(friction_gradient), DFSPH(relaxation),             \
              DFSPH(pressure_of_term), DFSPH(least_squares), DFSPH(surface_lack), DFSPH(surface_slope)),     \
        BLOCK("sim/pbf/pbf_block.h", PbfBlock, PBF(gradient), PBF(friction_gradient), PBF(relaxation),       \
              PBF(least_squares), PBF(pressure_of_term), PBF(viscous_dt), PBF(settle_rate),                  \
              PBF(boundary_fades)),                                                                          \
        BLOCK("sim/watch_block.h", WatchBlock, WATCH(greatest_speed2), WATCH(greatest_acceleration2),        \
              WATCH(greatest_density_ratio), WATCH(guarded), WATCH(went_too_far)),                           \
        BLOCK("sim/solid_steps_block.h", SolidStepsBlock, STEPS(solid_total), STEPS(boundary_total),         \
              STEPS(solids[0].begin.x), STEPS(solids[0].begin.r[0]), STEPS(solids[0].end.x),                 \
              STEPS(solids[0].end.r[0]), STEPS(solids[0].velocity), STEPS(solids[0].sticks),                 \
              STEPS(solids[0].spin), STEPS(solids[0].kind), STEPS(solids[0].change), STEPS(solids[0].alpha), \
              STEPS(solids[0].half_edges), STEPS(solids[0].radius), STEPS(solids[0].thickness),              \
              STEPS(solids[0].reach), STEPS(solids[15].reach)),                                              \
        BLOCK("sim/mesh_block.h", MeshBlock, MESH(meshes[0].exact_low), MESH(meshes[0].exact_cell),          \
              MESH(meshes[0].exact_inner), MESH(meshes[0].exact_scale), MESH(meshes[0].low),                 \
              MESH(meshes[0].cell), MESH(meshes[0].inner), MESH(meshes[0].scale), MESH(meshes[0].size),      \
              MESH(meshes[0].first), MESH(meshes[15].first)),                                                \
        BLOCK("sim/exact_shapes_block.h", ExactShapesBlock, SHAPE(exact_shapes[0].half_edges),               \
              SHAPE(exact_shapes[0].radius), SHAPE(exact_shapes[0].thickness), SHAPE(exact_shapes[0].reach), \
              SHAPE(exact_shapes[15].reach)),                                                                \
        BLOCK("sim/flow_block.h", FlowBlock, FLOW(drain_total), FLOW(guide_total), FLOW(gridded),            \
              FLOW(candidate_total), FLOW(layer_fluid), FLOW(particle_most), FLOW(layer_velocity),           \
              FLOW(drains[0].low), FLOW(drains[0].ball), FLOW(drains[0].high), FLOW(drains[0].radius2),      \
              FLOW(drains[7].radius2), FLOW(guides[0].centre), FLOW(guides[0].radius),                       \
              FLOW(guides[0].direction), FLOW(guides[0].depth), FLOW(guides[0].velocity),                    \
              FLOW(guides[0].fluid), FLOW(guides[31].fluid)),                                                \
        BLOCK("sim/flow_counts_block.h", FlowCounts, COUNTS(there), COUNTS(born), COUNTS(flowed[0])),        \
        BLOCK("sim/solve_block.h", SolveBlock, GROUPS_OF(pass_groups), GROUPS_OF(sum_groups),                \
              GROUPS_OF(decision_groups), GROUPS_OF(renewal_groups), GROUPS_OF(renewal_sum_groups),          \
              GROUPS_OF(renewal_decision_groups), GROUPS_OF(coarse_groups), GROUPS_OF(coarse_cell_groups),   \
              GROUPS_OF(coarse_solve_groups), SOLVE(pass_groups_along), SOLVE(sum_groups_along),             \
              SOLVE(renewal_groups_along), SOLVE(coarse_cell_groups_along), SOLVE(coarse),                   \
              SOLVE(iterations), SOLVE(left_mean), SOLVE(left_most), SOLVE(left_before), SOLVE(left_second), \
              SOLVE(tolerance), SOLVE(worst), SOLVE(iterations_few), SOLVE(iterations_most), SOLVE(ended),   \
              SOLVE(particles), SOLVE(scaled), SOLVE(go), SOLVE(turn), SOLVE(power), SOLVE(way_most),        \
              SOLVE(rounds_most), SOLVE(rounds), SOLVE(round_iterations[0]))

#endif
