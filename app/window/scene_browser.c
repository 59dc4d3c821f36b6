#include "app/files/pictures.h"
#include "app/run/compare/compare.h"
#include "app/scene/scene.h"
#include "app/scene/yaml/yaml.h"
#include "app/window/play.h"
#include "sim/start/start.h"
#include "sim/world.h"

#include <dirent.h>
#include <epoxy/gl.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Returns the end of a sentence within `length` bytes: after a full stop followed by a space, or `length`. */
static size_t sentence_end(const char *text, size_t length)
{
    for (size_t i = 0; i + 1 < length; i++)
        if (text[i] == '.' && text[i + 1] == ' ')
            return i + 1;
    return length;
}

void scene_head(const char *text, size_t size, char *head, size_t most)
{
    size_t used = 0;
    bool paragraph = false;
    const char *end = text + size;
    *head = 0;
    while (text < end && *text == '#' && used + 1 < most) {
        const char *line = text + 1;
        const char *stop = memchr(text, '\n', (size_t)(end - text));
        text = stop ? stop + 1 : end;
        while (line < end && *line == ' ')
            line++;
        const size_t length = stop && stop > line ? (size_t)(stop - line) : stop ? 0 : (size_t)(end - line);
        const char *gap = !used || length == 0 ? "" : paragraph ? "\n" : " ";
        used += (size_t)snprintf(head + used, most - used, "%s%.*s", gap, (int)length, line);
        used = used < most - 1 ? used : most - 1;
        paragraph = length == 0;
    }
    text_tame(head); /* of a comment, which YAML does not look at */
}

/* The first sentence of the head. */
static void scene_idea(const char *text, size_t size, char idea[256])
{
    scene_head(text, size, idea, 256);
    idea[sentence_end(idea, strcspn(idea, "\n"))] = 0;
}

static void read_words(SceneRow *row)
{
    Error none;
    size_t size;
    char *text = scene_file_read(row->path, &size, &none);
    YamlTree tree = {.path = row->path};
    snprintf(row->title, sizeof row->title, "%s", row->name);
    text_tame(row->title);
    *row->idea = 0;
    if (!text)
        return;
    scene_idea(text, size, row->idea);
    const YamlNode *title =
        tree_read(&tree, row->path, text, size, &none) ? node_child(tree.root, "title") : NULL;
    if (title && title->kind == NODE_SCALAR && title->text)
        snprintf(row->title, sizeof row->title, "%s", title->text);
    tree_free(&tree);
    free(text);
}

/* Returns false if the path is too long. */
static bool fill_row(SceneRow *row, const char *folder, const char *file)
{
    const int length = snprintf(row->path, sizeof row->path, "%s/%s", folder, file);
    snprintf(row->name, sizeof row->name, "%.*s", (int)(strlen(file) - strlen(".yaml")), file);
    if (length >= (int)sizeof row->path)
        return false;
    read_words(row);
    return true;
}

static bool read_folder(const char *folder, SceneList *list, Error *error)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, scene_path_is_yaml, alphasort);
    if (count < 0)
        return error_set(error, "%.300s: %s", folder, strerror(errno));
    list->rows = calloc((size_t)count + 1, sizeof *list->rows);
    for (int i = 0; i < count; i++) {
        if (list->rows && fill_row(&list->rows[list->count], folder, entries[i]->d_name))
            list->count++;
        free(entries[i]);
    }
    free(entries);
    return list->count > 0 || error_set(error,
                                        list->rows ? "%.300s: no scene (*.yaml) is there"
                                                   : "%.300s: no memory for the list of scenes",
                                        folder);
}

static bool read_own(SceneList *list, Error *error)
{
    SceneNames names;
    scene_path_names(&names);
    list->rows = calloc((size_t)names.count + 1, sizeof *list->rows);
    if (!list->rows)
        return error_set(error, "no memory for the list of scenes");
    for (int i = 0; i < names.count; i++) {
        SceneRow *row = &list->rows[list->count];
        if (!scene_path_find(names.name[i], row->path, error))
            continue;
        snprintf(row->name, sizeof row->name, "%s", names.name[i]);
        read_words(row);
        list->count++;
    }
    return list->count > 0 || error_set(error, "the scenes that come with slosh are not there");
}

bool scene_list_read(const char *folder, SceneList *list, Error *error)
{
    *list = (SceneList){.count = 0};
    if (folder ? read_folder(folder, list, error) : read_own(list, error))
        return true;
    scene_list_free(list);
    return false;
}

void scene_list_free(SceneList *list)
{
    free(list->rows);
    *list = (SceneList){.count = 0};
}

/* About a second on one processor for most scenes: thirty thumbnails take half a minute. */
static const double WORK_MOST = 2e6; /* particles times steps */
enum { STEPS_MOST = 400, PARTICLES_3D = 4000, PARTICLES_2D = 1500 };

/* Time of the picture, s: falling fluid is moving; with an emitter, later, so that some fluid is there. */
static const double TIME_S = 0.6, TIME_FILLED_S = 2;

static bool has_emitter(const WorldDef *def)
{
    for (int i = 0; i < def->fluid_count; i++)
        if (def->fluids[i].emit_count > 0)
            return true;
    return false;
}

/* Loads the scene with fewer particles if it has many, and without the legend, too large for a small
   picture. */
static bool load(const char *path, Scene *scene, Error *error)
{
    size_t size;
    char *text = scene_file_read(path, &size, error);
    SceneSettings settings = {.count = 0};
    settings.set[settings.count++] = "view.legend=false";
    bool ok = text && scene_parse(path, text, size, &settings, scene, NULL, error);
    const size_t count = ok ? seed_count(&scene->world, scene->world.spacing) : 0;
    const size_t most = scene->world.dimensions == 2 ? PARTICLES_2D : PARTICLES_3D;
    if (ok && count > most) {
        settings.particles = most;
        ok = scene_parse(path, text, size, &settings, scene, NULL, error);
    }
    free(text);
    return ok;
}

static bool simulate(Session *session, Error *error)
{
    const double time = has_emitter(&session->run.scene.world) ? TIME_FILLED_S : TIME_S;
    double work = 0;
    while (session->run.info.time < time && work < WORK_MOST && session->run.info.step < STEPS_MOST) {
        const uint64_t before = session->run.info.step;
        if (!session_step(session, error))
            return false;
        work += (double)session->run.info.count * (double)(session->run.info.step - before);
    }
    return true;
}

static bool draw(const Session *session, Image *image, Error *error)
{
    PanelPictures panel_pictures = {.source_count = 0};
    const PicturePanel panel = {.session = session, .view = &session->run.scene.view};
    const bool ok =
        panel_pictures_open(&panel_pictures, &panel, 1, THUMBNAIL_WIDTH, THUMBNAIL_HEIGHT, error) &&
        panel_pictures_take(&panel_pictures, session->run.info.time, error) &&
        panel_pictures_draw(&panel_pictures, error);
    if (ok) {
        *image = panel_pictures.image;
        panel_pictures.image = (Image){0};
    }
    panel_pictures_close(&panel_pictures);
    return ok;
}

bool thumbnail_make(const char *path, Headless *context, Image *image, Error *error)
{
    Session *session = calloc(1, sizeof *session);
    if (!session)
        return error_set(error, "%s: no memory", path);
    *session = (Session){.began_ms = wall_ms(), .context = context, .borrows = true};
    const bool ok = load(path, &session->run.scene, error) && session_start(session, -1, true, error) == 0 &&
                    simulate(session, error) && draw(session, image, error);
    session_close(session);
    free(session);
    return ok;
}

bool thumbnail_path(const char *folder, const char *name, char path[1024])
{
    return snprintf(path, 1024, "%s/%s.png", folder, name) < 1024;
}

bool thumbnail_is_new(const char *thumbnail, const char *scene)
{
    struct stat own, of, program;
    return stat(thumbnail, &own) == 0 && stat(scene, &of) == 0 && own.st_mtime >= of.st_mtime &&
           (stat("/proc/self/exe", &program) != 0 || own.st_mtime >= program.st_mtime);
}

extern char **environ;

static const double LOOK_MS = 300;
enum { NICE = 10 }; /* low priority: the fluid in the window comes first */

/* Makes a folder and its parents. */
static bool make_folders(char *path, Error *error)
{
    for (char *slash = path + 1; (slash = strchr(slash, '/')); slash++) {
        *slash = 0;
        const bool made = mkdir(path, 0777) == 0 || errno == EEXIST;
        *slash = '/';
        if (!made)
            break;
    }
    return mkdir(path, 0777) == 0 || errno == EEXIST ||
           error_set(error, "no pictures of scenes: %.300s: %s", path, strerror(errno));
}

/* FNV-1a: separates scenes with equal names in different folders. */
static unsigned hash_of(const char *text)
{
    uint32_t hash = 2166136261U;
    while (*text)
        hash = (hash ^ (uint8_t)*text++) * 16777619U;
    return hash;
}

/* Finds the cache folder after the XDG base directory specification, which ignores relative paths. */
static bool find_cache(BrowserFolder *from, Error *error)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    const bool own = cache && *cache == '/';
    char name[32] = "scenes";
    if (*from->folder)
        snprintf(name, sizeof name, "scenes-%08x", hash_of(from->folder));
    const int length = own    ? snprintf(from->cache, sizeof from->cache, "%s/slosh/%s", cache, name)
                       : home ? snprintf(from->cache, sizeof from->cache, "%s/.cache/slosh/%s", home, name)
                              : -1;
    const bool found =
        length > 0 && length < (int)sizeof from->cache
            ? make_folders(from->cache, error)
            : error_set(error, "no pictures of scenes: neither XDG_CACHE_HOME nor HOME names a folder");
    if (!found)
        *from->cache = 0;
    return found;
}

static void add_folder(SceneBrowser *cards, const char *folder)
{
    BrowserFolder *from = &cards->folders[cards->folder_count];
    Error none;
    char *whole = folder ? realpath(folder, NULL) : NULL;
    if (whole)
        snprintf(from->folder, sizeof from->folder, "%s", whole);
    free(whole);
    cards->folder_count += scene_list_read(folder, &from->list, &none);
}

/* Adds the shelves; the open scene's folder is a second shelf unless it came with slosh. */
static void find_shelves(SceneBrowser *cards, const char *scene)
{
    char folder[1024] = ".";
    const char *slash = strrchr(scene, '/');
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - scene), scene);
    add_folder(cards, NULL);
    const SceneList *own = &cards->folders[0].list;
    const size_t length = strlen(folder);
    if (own->count > 0 && strncmp(own->rows[0].path, folder, length) == 0 &&
        strchr(own->rows[0].path + length + 1, '/') == NULL)
        return;
    add_folder(cards, folder);
}

static bool make_cards(SceneBrowser *cards, Error *error)
{
    int count = 0;
    for (int s = 0; s < cards->folder_count; s++)
        count += cards->folders[s].list.count;
    cards->cards = count > 0 ? calloc((size_t)count, sizeof *cards->cards) : NULL;
    if (!cards->cards)
        return error_set(error, "there is no scene to choose");
    for (int s = cards->folder_count; s-- > 0;) /* neighbours of the open scene first */
        for (int i = 0; i < cards->folders[s].list.count; i++) {
            const SceneRow *row = &cards->folders[s].list.rows[i];
            cards->cards[cards->count++] =
                (PanelCard){.title = row->title, .text = row->idea, .path = row->path};
        }
    return true;
}

bool scene_browser_open(SceneBrowser *cards, const char *scene, Error *error)
{
    *cards = (SceneBrowser){.count = 0};
    find_shelves(cards, scene);
    if (!make_cards(cards, error))
        return false;
    bool all = true;
    for (int s = 0; s < cards->folder_count; s++)
        all &= find_cache(&cards->folders[s], error);
    return all;
}

/* ---- second process ---- */

static void start_maker(SceneBrowser *cards, BrowserFolder *from)
{
    char *arguments[8] = {"slosh", "scenes", "--quiet", "-o", from->cache, NULL};
    posix_spawn_file_actions_t actions;
    from->made = true;
    if (!*from->cache || posix_spawn_file_actions_init(&actions) != 0)
        return;
    if (*from->folder)
        arguments[5] = from->folder;
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    if (posix_spawn(&cards->maker, "/proc/self/exe", &actions, NULL, arguments, environ) != 0)
        cards->maker = 0;
    else
        setpriority(PRIO_PROCESS, (id_t)cards->maker, NICE);
    posix_spawn_file_actions_destroy(&actions);
}

static bool lacks_picture(const BrowserFolder *from)
{
    char path[1024];
    bool lacks = false;
    for (int i = 0; *from->cache && i < from->list.count; i++)
        lacks |= thumbnail_path(from->cache, from->list.rows[i].name, path) &&
                 !thumbnail_is_new(path, from->list.rows[i].path);
    return lacks;
}

static void follow_maker(SceneBrowser *cards)
{
    if (cards->maker && waitpid(cards->maker, NULL, WNOHANG) == 0)
        return;
    cards->maker = 0;
    for (int s = cards->folder_count; s-- > 0 && !cards->maker;)
        if (!cards->folders[s].made && lacks_picture(&cards->folders[s]))
            start_maker(cards, &cards->folders[s]);
}

/* ---- pictures ---- */

static unsigned make_texture(const Image *image)
{
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 3, GL_RGB8, image->width, image->height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture, 0, 0, 0, image->width, image->height, GL_RGB, GL_UNSIGNED_BYTE, image->rgb);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glGenerateTextureMipmap(texture);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    return texture;
}

static bool load_picture(const BrowserFolder *from, const SceneRow *row, PanelCard *card)
{
    char path[1024];
    Image image;
    Error none;
    if (card->texture || !*from->cache || !thumbnail_path(from->cache, row->name, path) ||
        !thumbnail_is_new(path, row->path) || !image_read(path, &image, &none))
        return false;
    if (image.width >= 4 && image.height >= 4) /* enough for three mip levels */
        card->texture = make_texture(&image);
    image_destroy(&image);
    return card->texture != 0;
}

bool scene_browser_poll(SceneBrowser *cards)
{
    bool come = false;
    int at = 0;
    if (wall_ms() < cards->looked_ms + LOOK_MS)
        return false;
    cards->looked_ms = wall_ms();
    for (int s = cards->folder_count; s-- > 0;)
        for (int i = 0; i < cards->folders[s].list.count; i++)
            come |= load_picture(&cards->folders[s], &cards->folders[s].list.rows[i], &cards->cards[at++]);
    follow_maker(cards);
    return come;
}

/* Ends the second process; it stops after its present picture and leaves no partial file. */
void scene_browser_close(SceneBrowser *cards)
{
    if (cards->maker)
        kill(cards->maker, SIGTERM);
    for (int i = 0; i < cards->count; i++)
        glDeleteTextures(1, &cards->cards[i].texture);
    free(cards->cards);
    for (int s = 0; s < BROWSER_FOLDERS; s++)
        scene_list_free(&cards->folders[s].list);
    *cards = (SceneBrowser){.count = 0};
}
