"""Imports a package that is not there."""
import torch_that_nobody_has
