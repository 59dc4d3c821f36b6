#include "render/slice/slice_def.h"

#include "render/plane/plane_kernel.h"
#include "sim/base/key_rows.h"

static const char *const show_names[] = {[SLICE_PLANE] = "plane", [SLICE_FLAT] = "flat", NULL};

static const char *const particles_names[] = {
    [SLICE_ALONE] = "none", [SLICE_BEHIND] = "behind", [SLICE_BOTH] = "both", NULL};

const SliceDef slice_usual = {.normal = {0, 0, 1}, .samples = 512, .cut = 0.25, .opacity = 1};

#define AT(field) offsetof(SliceDef, field)

/* clang-format off */
const Key slice_keys[] = {
    MAPPING("view.slice", "of the view slice: a scalar on a plane through the fluid"),
    VEC3("view.slice.point", L, "m", -1e6, 1e6, AT(point), "that the plane goes through, in the box's frame; two dimensions have one plane only"),
    VEC3("view.slice.normal", L, "", -1e6, 1e6, AT(normal), "across the plane, of any length but 0"),
    NUMBER("view.slice.play", L, "m/s", -1e3, 1e3, AT(play), "the plane goes along its normal, to and fro through the box, in simulated time; it begins at point"),
    CHOICE_OF("view.slice.show", L | KEY_INDEX, show_names, AT(show), "plane: where it is in the box; flat: filling the picture"),
    CHOICE_OF("view.slice.kernel", L | KEY_INDEX, plane_kernels, AT(kernel), "that sums are made with; its support radius is the solver's"),
    BOOLEAN("view.slice.raw", L, AT(raw), "sum V W s as it is; else over sum V W, the mean that is right near the surface too"),
    INTEGER("view.slice.samples", L, 16, 8192, AT(samples), "along the longer side where it is shown in the box; flat has one a pixel"),
    NUMBER("view.slice.cut", L, "", 0, 1, AT(cut), "where sum V W is less there is no fluid to be shown; a plane surface has 0.5"),
    CHOICE_OF("view.slice.particles", L | KEY_INDEX | KEY_REBUILD, particles_names, AT(particles), "shown with the plane in three dimensions; behind: those that its normal points away from"),
    NUMBER("view.slice.opacity", L, "", 0, 1, AT(opacity), "of the plane where it is in the box"),
    INTEGER("view.slice.isolines", L, 0, 100, AT(isolines), "lines of equal value between the ends of the range"),
    KEYS_END,
};
/* clang-format on */

const ViewGrade slice_grades[] = {
    {"view.slice.samples", {"64", "128", "256", "512", "1024"}, NULL, NULL, false},
    {0},
};

SliceDef *slice_def(const ViewDef *def)
{
    return view_own(def, &view_slice);
}
