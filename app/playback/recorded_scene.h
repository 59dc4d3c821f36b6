/* The scene of a file of snapshots: what views need of it. */
#ifndef SLOSH_RECORDED_SCENE_H
#define SLOSH_RECORDED_SCENE_H

#include "app/output/snapshot.h"
#include "app/scene/scene.h"

/* Builds it of the root's attributes: lengths and fluids to the bit, all else by the file's settings (nine
   digits, of colours three). `settings` (NULL: none) may set keys of the view alone: any other is refused,
   with its name. What the file does not say, or says in words that this slosh does not know, is a line of
   `notes` (may be NULL). False with the reason. */
bool recorded_scene(const SnapshotReader *reader, const char *path, const SceneSettings *settings,
                    SnapshotScene *numbers, Scene *scene, Notes *notes, Error *error);

#endif
