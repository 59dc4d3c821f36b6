/* The files that a scene names: tables of heights and velocities at the start, meshes. */
#ifndef SLOSH_SCENE_TABLES_H
#define SLOSH_SCENE_TABLES_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Reads the tables that the scene names, found from the folder of tree->path, into its world; checks that
   they fit its dimensions. A table that was read lives as long as the program: scenes are copied, and worlds
   made of them, with nobody to own it; a file with the same bytes is kept once. False with "file:line: ...".
 */
bool scene_read_tables(const Tree *tree, Scene *scene, Error *error);

/* Reads the meshes that it names, found in the same way and kept as long; NULL notes are allowed. Of a
   recorded run, one that cannot be read stays without a shape, and the notes say so. */
bool scene_read_meshes(const Tree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                       Error *error);

/* Whether the value of a key is the name of a table: it ends in ".csv". */
bool scene_names_table(const char *text);

/* Calls `named` with each node that is the name of a file, of a table or what a key `file` has, and with the
   path of its key. */
typedef void FileNamed(void *user, Node *node, const char *path);
void scene_each_file(Tree *tree, FileNamed *named, void *user);

/* The same of a mesh, by the endings of their formats. */
bool scene_names_mesh(const char *text);

/* The path of a file that a scene names, from the scene's folder; of one that a picture carries, else where
 * scenes are looked for. */
bool scene_beside_path(const char *scene, const char *name, char path[1200], Error *error);

/* The same for what is read of a recorded run: beside its snapshots, else in the folder that the scene was
   in, else where scenes are looked for. False with what is missing. */
bool scene_recorded_path(const char *snapshots, const char *folder, const char *name, char path[1200],
                         Error *error);

/* Calls `found` with each "table", "mesh" and "volume" that the scene in these bytes names once the settings
   (NULL: none) are made, for whoever must not write over them: of a volume with its header and its raw file.
   Reads headers alone; of a text that is no scene, finds none. */
void scene_find_tables(const char *path, const char *bytes, size_t size, const SceneSettings *settings,
                       void (*found)(void *user, const char *what, const char *path), void *user);

/* Tables, meshes and volumes are found from the scene's folder. Calls `moved` with each that a scene at
   `output` would not find any more: its node, the path of its key, and the file's whole name. */
typedef void FileMoved(void *user, Node *node, const char *path, const char *whole);
void scene_move_files(Tree *tree, const char *output, FileMoved *moved, void *user);

/* Whether the scene names any. */
bool scene_has_tables(const Scene *scene);

#endif
