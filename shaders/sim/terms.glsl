// What wcsph, surface tension and no-slip walls need beyond constants.glsl: mirrors sim/gl/compute/terms.c.
layout(std140, binding = 3) uniform Terms {
    vec4 term_scales;             // -W'(r) / r over f(r / h); diffusion of density; of the colour field; R of radial friction
    vec4 fluid_terms[FLUIDS_MAX]; // Tait's B, artificial viscosity, tension
    ivec4 drag_nodes;             // of the tables of one, two, three faces
    vec4 drag_steps;              // their inverse steps; w: range
    ivec4 drag_offset;            // where they begin
    vec4 term_lid;                // velocity of the wall at the top
    vec4 term_shift;              // chi c h / 2; of the return of density, 1/s; dimensions
};
