/* The checks that scene_advise lists. */
#ifndef SLOSH_SCENE_ADVISE_PARTS_H
#define SLOSH_SCENE_ADVISE_PARTS_H

#include "app/scene/advise.h"

/* That fluid may come to, by what it starts with and its fall, m/s. */
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
