/* Files named by a scene: tables of heights and velocities at the start, meshes. */
#ifndef SLOSH_SCENE_TABLES_H
#define SLOSH_SCENE_TABLES_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Reads the scene's tables into its world, with paths relative to the folder of tree->path; checks that the
   tables fit the dimensions. A table lives as long as the program, as copies of scenes and worlds share the
   table without an owner; files with the same bytes are kept once. Returns false with "file:line: ...". */
bool scene_read_tables(const Tree *tree, Scene *scene, Error *error);

/* Reads the scene's meshes, found and kept like tables; NULL notes are allowed. In a recorded run an
   unreadable mesh gets no shape, with a note. */
bool scene_read_meshes(const Tree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                       Error *error);

/* True if the value of a key names a table: it ends in ".csv". */
bool scene_names_table(const char *text);

/* Calls `named` with the node and the key's path of each file name: of a table, or the value of a key
   `file`. */
typedef void FileNamed(void *user, Node *node, const char *path);
void scene_each_file(Tree *tree, FileNamed *named, void *user);

/* True if the text names a mesh, by the suffix. */
bool scene_names_mesh(const char *text);

/* Path of a file named by a scene: in the scene's folder; if missing there and the scene is a link, in the
   folder of the link's target. For a scene in a picture, also in the search path for scenes. Returns false if
   the path is too long. */
bool scene_beside_path(const char *scene, const char *name, char path[1200], Error *error);

/* True if a file exists at `path`, the result of scene_beside_path; else the error lists the places
   searched. */
bool scene_file_is_there(const char *scene, const char *name, const char *path, Error *error);

/* Path of a file of a recorded run: beside the snapshots, else in the scene's former folder, else in the
   search path for scenes. Returns false if the file is missing; the error names the places searched. */
bool scene_recorded_path(const char *snapshots, const char *folder, const char *name, char path[1200],
                         Error *error);

/* Calls `found` with each "table", "mesh" and "volume" of the scene in the bytes after the settings (NULL:
   none), so that callers do not overwrite these files. A volume counts as its header and its raw file. Reads
   headers only; finds nothing in an invalid scene. */
void scene_find_tables(const char *path, const char *bytes, size_t size, const SceneSettings *settings,
                       void (*found)(void *user, const char *what, const char *path), void *user);

/* Tables, meshes and volumes are found from the scene's folder. Calls `moved` for each file that a scene at
   `output` would not find: its node, the path of its key, and the file's full path. */
typedef void FileMoved(void *user, Node *node, const char *path, const char *whole);
void scene_move_files(Tree *tree, const char *output, FileMoved *moved, void *user);

/* True if the scene has tables. */
bool scene_has_tables(const Scene *scene);

#endif
