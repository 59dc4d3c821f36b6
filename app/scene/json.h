/* The settings of a scene as JSON. */
#ifndef SLOSH_SCENE_JSON_H
#define SLOSH_SCENE_JSON_H

#include "app/scene/scene.h"

#include <jansson.h>

/* {"fluids[0].viscosity": {"value": 0.5, "unit": "Pa s"}, ...}: each line of scene_print. Numbers and lists
   keep their type, other values are text; unitless values have no unit. The caller owns the result; NULL if
   memory is short. */
json_t *scene_json(const Scene *scene);

#endif
