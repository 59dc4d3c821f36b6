/* The scenes of a folder for choosing: name, title and idea. */
#ifndef APP_WINDOW_SCENE_BROWSER_H
#define APP_WINDOW_SCENE_BROWSER_H

#include "app/files/pictures.h"
#include "app/run/offscreen.h"
#include "app/scene/scene_files.h"
#include "app/window/panel/panel.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <sys/types.h>

typedef struct SceneRow {
    char name[64]; /* file name without .yaml */
    char path[SCENE_PATH_SIZE];
    char title[128]; /* key `title`; without title the name */
    char idea[256];  /* first sentence of the file's head comment; "": none */
} SceneRow;

typedef struct SceneList {
    int count;
    SceneRow *rows; /* owned; ordered by name */
} SceneList;

/* Lists the scenes of a folder; NULL: the scenes that come with slosh. Broken YAML files are listed too:
   opening the file shows the error. Returns false with the reason: no such folder, no memory, no scene. */
bool scene_list_read(const char *folder, SceneList *list, Error *error);
void scene_list_free(SceneList *list); /* a zeroed one is allowed */

/* Thumbnails: small pictures of scenes, for lists. */

enum { THUMBNAIL_WIDTH = 256, THUMBNAIL_HEIGHT = 144 };

/* Simulates the scene briefly with few particles, and draws its own view in the current context. The
   caller owns the image. Returns false with the reason: the scene is wrong, or cannot run here. */
bool thumbnail_make(const char *path, Headless *context, Image *image, Error *error);

/* Makes the path of scene `name` in a folder of thumbnails; returns false if too long. */
bool thumbnail_path(const char *folder, const char *name, char path[1024]);

/* True if the thumbnail exists and is newer than the scene and the program. */
bool thumbnail_is_new(const char *thumbnail, const char *scene);

/* The scenes of the window's list, with pictures. A second process draws the pictures into the user's
   cache while the list is shown, so that the fluid in the window goes on. */

enum { BROWSER_FOLDERS = 2 };

/* Scenes of one folder. */
typedef struct BrowserFolder {
    SceneList list;
    char folder[1024]; /* of the scenes; "": the scenes that come with slosh */
    char cache[1024];  /* folder of their pictures; "": no pictures possible */
    bool made;         /* true once the second process was started */
} BrowserFolder;

/* Zero-initialise before use. */
typedef struct SceneBrowser {
    int count;
    PanelCard *cards; /* owned; cards of all shelves */
    int folder_count;
    BrowserFolder folders[BROWSER_FOLDERS];
    pid_t maker;      /* the second process; 0: none */
    double looked_ms; /* wall time of the last look for new pictures */
} SceneBrowser;

/* Lists the scenes beside the open scene, and the scenes that come with slosh. Returns false with the
   reason if there are no pictures or no list; call scene_browser_close in any case. All three functions need
   a current GL context. */
bool scene_browser_open(SceneBrowser *cards, const char *scene, Error *error);

/* Returns true if pictures have arrived since the last call. */
bool scene_browser_poll(SceneBrowser *cards);

void scene_browser_close(SceneBrowser *cards);

#endif
