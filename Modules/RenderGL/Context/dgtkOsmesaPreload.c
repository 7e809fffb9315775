/* SPDX-License-Identifier: BSD-3-Clause */
/* Lets a program whose libraries look OpenGL up through GLX draw with OSMesa instead. */
typedef void (*Function)(void);
Function OSMesaGetProcAddress(const char* name);

Function glXGetProcAddressARB(const unsigned char* name);
Function glXGetProcAddress(const unsigned char* name);
extern const int dgtkOsmesaPreloaded;
const int dgtkOsmesaPreloaded = 1;

Function glXGetProcAddressARB(const unsigned char* name)
{
  return OSMesaGetProcAddress((const char*)name);
}

Function glXGetProcAddress(const unsigned char* name)
{
  return OSMesaGetProcAddress((const char*)name);
}
