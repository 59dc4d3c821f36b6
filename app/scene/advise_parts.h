/* Checks called by scene_advise. */
#ifndef SLOSH_SCENE_ADVISE_PARTS_H
#define SLOSH_SCENE_ADVISE_PARTS_H

#include "app/scene/advise.h"

/* Greatest expected speed of the fluid, from the start and the fall, m/s. */
double scene_greatest_speed(const WorldDef *def);

void advise_step(const Tree *tree, const Scene *scene, Notes *notes);
void advise_method(const Tree *tree, const Scene *scene, Notes *notes);
void advise_sound(const Tree *tree, const Scene *scene, Notes *notes);
void advise_places(const Tree *tree, const Scene *scene, Notes *notes);
void advise_borne(const Tree *tree, const Scene *scene, Notes *notes);
void advise_cohesion(const Tree *tree, const Scene *scene, Notes *notes);
void advise_slip(const Tree *tree, const Scene *scene, Notes *notes);

void advise_solids(const Tree *tree, const Scene *scene, Notes *notes);

void advise_probes(const Tree *tree, const Scene *scene, Notes *notes);

#endif
