/* The scene of a snapshot file, as needed by views. */
#ifndef SLOSH_RECORDED_SCENE_H
#define SLOSH_RECORDED_SCENE_H

#include "app/files/snapshot.h"
#include "app/scene/scene.h"

/* Builds the scene from the root's attributes: lengths and fluids with all bits, the rest from the file's
   settings (nine digits; colours three). `settings` (may be NULL) may set only keys of the view; any
   further key is refused by name. Missing or unknown settings of the file are noted in `notes` (may be
   NULL). Returns false with the reason. */
bool recorded_scene(const SnapshotReader *reader, const char *path, const SceneSettings *settings,
                    SnapshotScene *numbers, Scene *scene, Notes *notes, Error *error);

#endif
