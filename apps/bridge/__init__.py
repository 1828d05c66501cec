"""Other people's interfaces on the course's operations; their programs: python3 -m course run.

    tensors           between tensors and arrays, and whose code does the work
    card              where tensors would be, and what a card refuses
    nvdiffrast        what `import nvdiffrast.torch` finds
    neural_renderer   what `import neural_renderer` finds
    program           somebody's program, run as it is
    command           the command line of the package that is installed alone
    setup             a step of pip install apps/bridge
"""
