/* probe.h - can the system's loader map this object at all? Asked in a child process. */
#ifndef PROBE_H
#define PROBE_H

/* Loads and vets the object in a child that then ends. 0 if the child came through, whatever it found (the caller
 * will find it, too); STATUS_CASE, with a sentence that names the file, if it died: damaged relocations, code or
 * tables make the system's loader, constructors or pointers go astray, and nothing short of running shows it. */
int probe_object(const char *path);

#endif
