#include "sim/gl/mailbox.h"

#include <epoxy/gl.h>

bool mailbox_create(Mailbox *mailbox, const char *label, size_t bytes)
{
    const GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const GLsizeiptr size = (GLsizeiptr)bytes;
    mailbox->bytes = bytes;
    glCreateBuffers(1, &mailbox->buffer);
    glObjectLabel(GL_BUFFER, mailbox->buffer, -1, label);
    glNamedBufferStorage(mailbox->buffer, size, NULL, GL_DYNAMIC_STORAGE_BIT);
    glClearNamedBufferData(mailbox->buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    glCreateBuffers(1, &mailbox->copy);
    glObjectLabel(GL_BUFFER, mailbox->copy, -1, label);
    glNamedBufferStorage(mailbox->copy, size, NULL, access | GL_CLIENT_STORAGE_BIT);
    mailbox->mapped = glMapNamedBufferRange(mailbox->copy, 0, size, access);
    return mailbox->mapped != NULL;
}

void mailbox_destroy(Mailbox *mailbox)
{
    mailbox_forget(mailbox);
    glDeleteBuffers(1, &mailbox->buffer);
    glDeleteBuffers(1, &mailbox->copy);
    *mailbox = (Mailbox){0};
}

void mailbox_send(Mailbox *mailbox)
{
    mailbox_forget(mailbox);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(mailbox->buffer, mailbox->copy, 0, 0, (GLsizeiptr)mailbox->bytes);
    mailbox->fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

/* Opens the mailbox after arrival or failure. */
static const void *open(Mailbox *mailbox, GLenum arrived)
{
    mailbox_forget(mailbox);
    return arrived == GL_WAIT_FAILED ? NULL : mailbox->mapped;
}

const void *mailbox_wait(Mailbox *mailbox)
{
    if (!mailbox->fence)
        return NULL;
    GLenum arrived;
    do
        arrived = glClientWaitSync(mailbox->fence, GL_SYNC_FLUSH_COMMANDS_BIT, 1000000000);
    while (arrived == GL_TIMEOUT_EXPIRED);
    return open(mailbox, arrived);
}

const void *mailbox_look(Mailbox *mailbox)
{
    if (!mailbox->fence)
        return NULL;
    const GLenum arrived = glClientWaitSync(mailbox->fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    return arrived == GL_TIMEOUT_EXPIRED ? NULL : open(mailbox, arrived);
}

void mailbox_forget(Mailbox *mailbox)
{
    glDeleteSync(mailbox->fence);
    mailbox->fence = NULL;
}
