"""What the course gives: meshes, images, plots, gradient check, skeletons, board, command line."""
