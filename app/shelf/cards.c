#include "app/shelf/cards.h"

#include "app/files/pictures.h"
#include "app/shelf/thumbnail.h"
#include "sim/base/stage.h"

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
static bool find_cache(CardShelf *shelf, Error *error)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    const bool own = cache && *cache == '/';
    char name[32] = "scenes";
    if (*shelf->folder)
        snprintf(name, sizeof name, "scenes-%08x", hash_of(shelf->folder));
    const int length = own    ? snprintf(shelf->cache, sizeof shelf->cache, "%s/slosh/%s", cache, name)
                       : home ? snprintf(shelf->cache, sizeof shelf->cache, "%s/.cache/slosh/%s", home, name)
                              : -1;
    const bool found =
        length > 0 && length < (int)sizeof shelf->cache
            ? make_folders(shelf->cache, error)
            : error_set(error, "no pictures of scenes: neither XDG_CACHE_HOME nor HOME names a folder");
    if (!found)
        *shelf->cache = 0;
    return found;
}

static void add_shelf(SceneCards *cards, const char *folder)
{
    CardShelf *shelf = &cards->shelves[cards->shelf_count];
    Error none;
    char *whole = folder ? realpath(folder, NULL) : NULL;
    if (whole)
        snprintf(shelf->folder, sizeof shelf->folder, "%s", whole);
    free(whole);
    cards->shelf_count += scene_list_read(folder, &shelf->list, &none);
}

/* Adds the shelves; the open scene's folder is a second shelf unless it came with slosh. */
static void find_shelves(SceneCards *cards, const char *scene)
{
    char folder[1024] = ".";
    const char *slash = strrchr(scene, '/');
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - scene), scene);
    add_shelf(cards, NULL);
    const SceneList *own = &cards->shelves[0].list;
    const size_t length = strlen(folder);
    if (own->count > 0 && strncmp(own->rows[0].path, folder, length) == 0 &&
        strchr(own->rows[0].path + length + 1, '/') == NULL)
        return;
    add_shelf(cards, folder);
}

static bool make_cards(SceneCards *cards, Error *error)
{
    int count = 0;
    for (int s = 0; s < cards->shelf_count; s++)
        count += cards->shelves[s].list.count;
    cards->cards = count > 0 ? calloc((size_t)count, sizeof *cards->cards) : NULL;
    if (!cards->cards)
        return error_set(error, "there is no scene to choose");
    for (int s = cards->shelf_count; s-- > 0;) /* neighbours of the open scene first */
        for (int i = 0; i < cards->shelves[s].list.count; i++) {
            const SceneRow *row = &cards->shelves[s].list.rows[i];
            cards->cards[cards->count++] =
                (SceneCard){.title = row->title, .text = row->idea, .path = row->path};
        }
    return true;
}

bool cards_open(SceneCards *cards, const char *scene, Error *error)
{
    *cards = (SceneCards){.count = 0};
    find_shelves(cards, scene);
    if (!make_cards(cards, error))
        return false;
    bool all = true;
    for (int s = 0; s < cards->shelf_count; s++)
        all &= find_cache(&cards->shelves[s], error);
    return all;
}

/* ---- second process ---- */

static void start_maker(SceneCards *cards, CardShelf *shelf)
{
    char *arguments[8] = {"slosh", "scenes", "--quiet", "-o", shelf->cache, NULL};
    posix_spawn_file_actions_t actions;
    shelf->made = true;
    if (!*shelf->cache || posix_spawn_file_actions_init(&actions) != 0)
        return;
    if (*shelf->folder)
        arguments[5] = shelf->folder;
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    if (posix_spawn(&cards->maker, "/proc/self/exe", &actions, NULL, arguments, environ) != 0)
        cards->maker = 0;
    else
        setpriority(PRIO_PROCESS, (id_t)cards->maker, NICE);
    posix_spawn_file_actions_destroy(&actions);
}

static bool lacks_picture(const CardShelf *shelf)
{
    char path[1024];
    bool lacks = false;
    for (int i = 0; *shelf->cache && i < shelf->list.count; i++)
        lacks |= thumbnail_path(shelf->cache, shelf->list.rows[i].name, path) &&
                 !thumbnail_is_new(path, shelf->list.rows[i].path);
    return lacks;
}

static void follow_maker(SceneCards *cards)
{
    if (cards->maker && waitpid(cards->maker, NULL, WNOHANG) == 0)
        return;
    cards->maker = 0;
    for (int s = cards->shelf_count; s-- > 0 && !cards->maker;)
        if (!cards->shelves[s].made && lacks_picture(&cards->shelves[s]))
            start_maker(cards, &cards->shelves[s]);
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

static bool load_picture(const CardShelf *shelf, const SceneRow *row, SceneCard *card)
{
    char path[1024];
    Image image;
    Error none;
    if (card->texture || !*shelf->cache || !thumbnail_path(shelf->cache, row->name, path) ||
        !thumbnail_is_new(path, row->path) || !image_read(path, &image, &none))
        return false;
    if (image.width >= 4 && image.height >= 4) /* enough for three mip levels */
        card->texture = make_texture(&image);
    image_destroy(&image);
    return card->texture != 0;
}

bool cards_follow(SceneCards *cards)
{
    bool come = false;
    int at = 0;
    if (wall_ms() < cards->looked_ms + LOOK_MS)
        return false;
    cards->looked_ms = wall_ms();
    for (int s = cards->shelf_count; s-- > 0;)
        for (int i = 0; i < cards->shelves[s].list.count; i++)
            come |= load_picture(&cards->shelves[s], &cards->shelves[s].list.rows[i], &cards->cards[at++]);
    follow_maker(cards);
    return come;
}

/* Ends the second process; it stops after its present picture and leaves no partial file. */
void cards_close(SceneCards *cards)
{
    if (cards->maker)
        kill(cards->maker, SIGTERM);
    for (int i = 0; i < cards->count; i++)
        glDeleteTextures(1, &cards->cards[i].texture);
    free(cards->cards);
    for (int s = 0; s < CARD_SHELVES; s++)
        scene_list_free(&cards->shelves[s].list);
    *cards = (SceneCards){.count = 0};
}
