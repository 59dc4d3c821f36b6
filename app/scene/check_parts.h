/* Private to scene_check: checks of the parts of a scene, one file each. */
#ifndef SLOSH_SCENE_CHECK_PARTS_H
#define SLOSH_SCENE_CHECK_PARTS_H

#include "app/scene/check.h"

/* A scene to check. */
typedef struct Check {
    const Tree *tree;
    const Scene *scene;
    Error *error;
} Check;

/* Reports an error at the node of `path`, or at the nearest existing node. */
#define FAIL(check, path, ...)                                                                               \
    tree_error((check)->tree, tree_near((check)->tree, path), (check)->error, __VA_ARGS__)

/* check_box.c: places and directions in the box, motions, periodic sides, the lid. */
char scene_axis_name(int k);
/* True if low..high on axis k lies between the walls, up to rounding. */
bool scene_between_walls(const Check *check, const char *path, int k, double low, double high);
bool scene_check_axis(const Check *check, const char *path, const double axis[3]);
/* In two dimensions vectors must lie in the plane. */
bool scene_check_plane(const Check *check, const char *path, const double v[3]);
double scene_clamp_to_box(const Check *check, int k, double x);
/* Distance of the point from the box, m. */
double scene_outside_box(const Check *check, const double x[3]);
bool scene_check_motion(const Check *check, const char *list, int m, const Motion *motion);
bool scene_check_periodic(const Check *check);
bool scene_check_lid(const Check *check);

/* check_fluids.c: fills, emitters and drains. */
bool scene_check_fluid(const Check *check, int f);
bool scene_check_drain(const Check *check, int index);

/* check_solids.c */
bool scene_check_solid(const Check *check, int index);
/* Solids must not be thinner than a spacing: fluid on both sides would act as one fluid. */
bool scene_check_widths(const Check *check);

/* meshes.c: false, with a question about the scale behind the error where the mesh is longer than the box
   from corner to corner, or shorter than the spacing. NULL: of the first such mesh of the scene. */
bool scene_ask_scale(const Check *check, const MeshUse *mesh);

/* check_probes.c */
bool scene_check_probe(const Check *check, int index);
/* Metrics of probes need probes. */
bool scene_check_metrics(const Check *check);

#endif
