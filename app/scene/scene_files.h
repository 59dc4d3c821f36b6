/* Files of a scene: the scene file itself, found and read, also from a picture; and the files that a
   scene names. */
#ifndef APP_SCENE_SCENE_FILES_H
#define APP_SCENE_SCENE_FILES_H

#include "app/scene/scene.h"

#include "app/scene/yaml/yaml.h"
#include "slosh/error.h"

#include <dirent.h>
#include <stdbool.h>
#include <stddef.h>

enum { SCENE_PATH_SIZE = 1024, SCENE_NAMES_MAX = 64, SCENE_BYTES_MAX = 1 << 20 };

/* The scenes of slosh: names without .yaml, in alphabetical order. */
typedef struct SceneNames {
    int count;
    char name[SCENE_NAMES_MAX][48];
} SceneNames;

void scene_path_names(SceneNames *names);

/* For scandir: true if the entry's name is a scene file's. */
int scene_path_is_yaml(const struct dirent *entry);

/* The file of `name`: a path, otherwise a path or a bare name (with or without .yaml) in slosh's own folder.
   Then the user's folder (app/base/program.h), then a bare name in the present folder. Folders come last, as
   outputs have the names of scenes too. If there is no file, returns false with the searched places and the
   nearest scene name. */
bool scene_path_find(const char *name, char path[SCENE_PATH_SIZE], Error *error);

/* The file's bytes, or the scene embedded in a picture; the caller frees the bytes. NULL: a folder,
   unreadable, larger than SCENE_BYTES_MAX, or a file for a different command. */
char *scene_file_read(const char *path, size_t *size, Error *error);

/* The scene embedded in a picture of slosh, in the text of the PNG file. */

/* Keywords of the chunks, all iTXt before the pixels: the scene's YAML, the name of the scene file, the time
   of the picture in s. */
#define PICTURE_SCENE "slosh scene"
#define PICTURE_NAME  "slosh name"
#define PICTURE_TIME  "slosh time"

enum { PICTURE_TEXT_MAX = 1 << 20, PICTURE_FILE_MAX = 256 << 20, PICTURE_NAME_SIZE = 128 };

typedef struct PictureText {
    char *scene;                  /* ended by a 0; the caller frees the text */
    size_t size;                  /* without the 0, at most PICTURE_TEXT_MAX */
    char name[PICTURE_NAME_SIZE]; /* "": none, or not plain ASCII */
    double time;                  /* NaN: not given */
} PictureText;

/* True if the path ends in ".png". */
bool picture_text_name(const char *path);

/* Parses a file in memory up to its pixels, of which only lengths and sums are checked; pure. Returns false
   with "path: ...", and nothing to free, if the file is cut or damaged, has no scene or two, or a too long
   text. The text is not checked: check the scene like any scene file. */
bool picture_text_parse(const char *path, const char *bytes, size_t size, PictureText *out, Error *error);

/* Reads and parses a file. */
bool picture_text_read(const char *path, PictureText *out, Error *error);

/* Files named by a scene: tables of heights and velocities at the start, meshes. */

/* Calls `named` with the node and the key's path of each file name: of a table, or the value of a key
   `file`. */
typedef void SceneFileNamed(void *user, YamlNode *node, const char *path);
void scene_each_file(YamlTree *tree, SceneFileNamed *named, void *user);

/* Path of a file named by a scene: in the scene's folder; if missing there and the scene is a link, in the
   folder of the link's target. For a scene in a picture, also in the search path for scenes. Returns false if
   the path is too long. */
bool scene_relative_path(const char *scene, const char *name, char path[1200], Error *error);

/* Calls `found` with each "table", "mesh" and "volume" of the scene in the bytes after the settings (NULL:
   none), so that callers do not overwrite these files. A volume counts as its header and its raw file. Reads
   headers only; finds nothing in an invalid scene. */
void scene_find_tables(const char *path, const char *bytes, size_t size, const SceneSettings *settings,
                       void (*found)(void *user, const char *what, const char *path), void *user);

/* Tables, meshes and volumes are found from the scene's folder. Calls `moved` for each file that a scene at
   `output` would not find: its node, the path of its key, and the file's full path. */
typedef void SceneFileMoved(void *user, YamlNode *node, const char *path, const char *whole);
void scene_move_files(YamlTree *tree, const char *output, SceneFileMoved *moved, void *user);

/* True if the scene has tables. */
bool scene_has_tables(const Scene *scene);

#endif
