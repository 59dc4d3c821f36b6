/* Keys of the solids. */
#include "sim/base/color.h"
#include "sim/base/key_rows.h"
#include "sim/matter/world_def.h"

#define AT(field)    offsetof(WorldDef, field)
#define SOLID(field) offsetof(SolidDef, field)

/* Keys of each kind of solid. */
#define CENTRE(S, HELP)    VEC3(S ".centre", R, "m", -1e6, 1e6, SOLID(centre), HELP),
#define DIRECTION(S, HELP) VEC3(S ".axis", 0, "", -1000, 1000, SOLID(axis), HELP),
#define RADIUS(S, HELP)    NUMBER(S ".radius", R | O, "m", 0, 1e6, SOLID(radius), HELP),

#define FIELDS_SPHERE(S) CENTRE(S, "its centre") RADIUS(S, "its radius")
#define FIELDS_BOX(S)                                                                                        \
    CENTRE(S, "its centre")                                                                                  \
    VEC3(S ".size", R, "m", 0, 1e6, SOLID(size), "lengths of its edges"),                                    \
        DIRECTION(S, "what it is turned about; in two dimensions [0, 0, 1]")                                 \
            NUMBER(S ".angle", 0, "degrees", -360, 360, SOLID(angle_deg), "how far it is turned"),
#define FIELDS_CYLINDER(S)                                                                                   \
    CENTRE(S, "its centre")                                                                                  \
    RADIUS(S, "its radius")                                                                                  \
    NUMBER(S ".height", R | O, "m", 0, 1e6, SOLID(height), "its length"), DIRECTION(S, "its direction")
#define FIELDS_BOWL(S)                                                                                       \
    CENTRE(S, "of its sphere, in the middle of its opening")                                                 \
    RADIUS(S, "inside")                                                                                      \
    NUMBER(S ".thickness", 0, "m", 0, 1e6, SOLID(thickness), "of its wall; 0: the support radius"),          \
        DIRECTION(S, "where it opens to")
#define FIELDS_MESH(S)                                                                                       \
    TEXT(S ".file", R, FILE_NAME_SIZE, SOLID(mesh.file), NULL,                                               \
         "found from the scene's folder: .obj, .ply, .stl, .gltf or .glb, of at most 2,000,000 triangles"),  \
        CENTRE(S, "where the middle of the block around it is")                                              \
            NUMBER(S ".scale", O, "m", 0, 1e6, SOLID(mesh.scale), "of a unit of the file"),                  \
        DIRECTION(S, "what it is turned about")                                                              \
            NUMBER(S ".angle", 0, "degrees", -360, 360, SOLID(angle_deg), "how far it is turned"),
#define SOLID_ROWS(KIND, NAME, HELP)                                                                         \
    VARIANT("solids[]." NAME, SOLID(kind), SOLID_##KIND, HELP), FIELDS_##KIND("solids[]." NAME)

static void solid_init(void *element, int index)
{
    (void)index;
    SolidDef *solid = element;
    solid->axis[1] = 1;
    solid->mesh.scale = 1;
    for (int k = 0; k < 3; k++)
        solid->color[k] = (float)srgb_to_linear(0.62); /* a grey unlike any fluid */
}

/* clang-format off */
const Key solid_keys[] = {
    LIST("solids", 0, 0, SOLIDS_MAX, AT(solids), AT(solid_count), SolidDef, solid_init,
         "bodies in the box that the fluid flows around, in its frame; each has one shape"),
    SOLID_LIST(SOLID_ROWS)
    CHOICE_OF("solids[].slip", KEY_INDEX, slip_names, SOLID(slip),
           "free: fluid glides along it; none: it sticks, by the fluid's viscosity", .off = "free"),
    COLOR("solids[].color", I | KEY_SINGLE, SOLID(color), NULL, "sRGB: [red, green, blue], each 0 to 1"),
    NUMBER("solids[].density", 0, "kg/m3", 0, 1e6, SOLID(density),
           "more than 0: fluid and gravity move the solid; 0: it stands, or has a motion"),
    MAPPING("solids[].hinge", "what such a solid turns about, and does not leave; fixed to the box"),
    VEC3("solids[].hinge.at", 0, "m", -1e6, 1e6, SOLID(hinge_at), "a point of the axis"),
    VEC3("solids[].hinge.axis", 0, "", -1000, 1000, SOLID(hinge_axis), "its direction; in two dimensions [0, 0, 1]"),
    LIST("solids[].motion", 0, 0, MOTIONS_MAX, SOLID(motions), SOLID(motion_count), Motion, NULL,
         "how it moves in the box; all together, turns about its centre"),
    KEYS_END,
};
/* clang-format on */
