// Boundary particles of solids (sim/solids/solid.h), sorted by cell in a separate grid: the fluids' buffers hold
// fluid only. BOUNDARY_ACCESS: access of the pass, if not readonly.
#include "shaders/sim/bindings.h"
#include "sim/cells.glsl"
#ifdef SOLIDS
#ifndef BOUNDARY_ACCESS
#define BOUNDARY_ACCESS readonly
#endif
layout(std430, binding = BOUNDARY_POSITIONS_BUFFER) BOUNDARY_ACCESS buffer BoundaryPositions { vec4 boundary_position[]; }; // w: volume in friction
layout(std430, binding = BOUNDARY_VELOCITIES_BUFFER) BOUNDARY_ACCESS buffer BoundaryVelocities { vec4 boundary_velocity[]; }; // w: viscosity
layout(std430, binding = BOUNDARY_STATES_BUFFER) BOUNDARY_ACCESS buffer BoundaryStates { uvec2 boundary_state[]; }; // p V0^2, number
layout(std430, binding = BOUNDARY_STARTS_BUFFER) readonly buffer BoundaryStarts { uint boundary_start[]; };

uvec2 boundary_row_of(ivec3 at, int row)
{
    ivec2 cells = row_cells(at, row);
    return uvec2(boundary_start[cells.x], boundary_start[cells.y]);
}
#endif
