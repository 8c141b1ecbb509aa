graph = 0
