# find_package(DGTk) for other projects: see Testing/Consumer.
