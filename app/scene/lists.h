/* What the rows of the table of keys refer to: the lists of names, by index, and the defaults. */
#ifndef SLOSH_SCENE_LISTS_H
#define SLOSH_SCENE_LISTS_H

/* The name at `index`, NULL from the end of the list on. */
const char *preset_choice(int index);
const char *method_choice(int index);
const char *tension_choice(int index);
const char *backend_choice(int index);
const char *view_choice(int index); /* the views, then "none" */
const char *colormap_choice(int index);
const char *scalar_choice(int index);
const char *step_mode_choice(int index);

/* Defaults of a list's element, which is zeroed: `index` is its place. */
const char *slip_choice(int index);
void fill_init(void *element, int index);
void solid_init(void *element, int index);
void fluid_init(void *element, int index);

#endif
