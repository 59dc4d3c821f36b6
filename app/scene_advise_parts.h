/* The checks that scene_advise lists. */
#ifndef SLOSH_SCENE_ADVISE_PARTS_H
#define SLOSH_SCENE_ADVISE_PARTS_H

#include "app/scene_advise.h"

void advise_friction(const Tree *tree, const Scene *scene, Notes *notes);

#endif
