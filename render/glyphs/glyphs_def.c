#include "render/glyphs/glyphs_def.h"

#include "sim/base/key_rows.h"

static const char *const at_names[] = {
    [GLYPHS_PARTICLES] = "particles", [GLYPHS_GRID] = "grid", [GLYPHS_PLANE] = "plane", NULL};
static const char *const color_names[] = {[GLYPHS_BY_SCALAR] = "scalar", [GLYPHS_PLAIN] = "plain", NULL};

const GlyphsDef glyphs_usual = {.stride = 20, .plane_normal = {0, 0, 1}, .color = {0.02, 0.02, 0.025}};

#define AT(field) offsetof(GlyphsDef, field)

/* clang-format off */
const Key glyphs_keys[] = {
    MAPPING("view.glyphs", "of the overlay glyphs: arrows of a vector, beside any view"),
    BOOLEAN("view.glyphs.show", L, AT(show), "draw them"),
    CHOICE_OF("view.glyphs.vector", L | KEY_INDEX, vector_list, AT(vector), "velocity: of the fluid in the box; vorticity: its curl; pressure_gradient; box_velocity: of the box itself where the fluid is, by the world's frame"),
    CHOICE_OF("view.glyphs.at", L | KEY_INDEX, at_names, AT(at), "particles: at every so many of them; grid, plane: means of the fluid around, evenly spread through the box or on a plane"),
    INTEGER("view.glyphs.stride", L, 1, 1000000, AT(stride), "every so many particles, by their ids, has one"),
    NUMBER("view.glyphs.cell", L, "m", 0, 1e6, AT(cell), "from arrow to arrow on a grid or a plane; 0: a 24th of the box's longest side"),
    NUMBER("view.glyphs.scale", L, "", 0, 1e12, AT(scale), "m in a unit of the vector; 0: so that of twenty arrows one is longer than 1.5 times the way from one to the next, about; the legend has it in either case"),
    VEC3("view.glyphs.plane_point", L, "m", -1e6, 1e6, AT(plane_point), "that the plane goes through, in the box's frame"),
    VEC3("view.glyphs.plane_normal", L, "", -1e6, 1e6, AT(plane_normal), "across the plane, of any length but 0"),
    CHOICE_OF("view.glyphs.color_by", L | KEY_INDEX, color_names, AT(color_by), "scalar: by view.color_by; plain: all alike"),
    COLOR("view.glyphs.color", L, AT(color), NULL, "of plain ones, sRGB: [red, green, blue], each 0 to 1"),
    KEYS_END,
};
/* clang-format on */

GlyphsDef *glyphs_def(const ViewDef *def)
{
    return overlay_own(def, &overlay_glyphs);
}
