# Python wrapping of the dgtk* classes by VTK's wrapper.
