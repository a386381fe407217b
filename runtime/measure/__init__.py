"""What a method costs and how far it can be trusted: the parts of `gudgeon bench` and `gudgeon stress`.

`work` says what is run and how runs are compared, `rhs` times one right-hand side, `cells` judges,
`figures` and `files` show and store. Later issues add methods and axes here.
"""
